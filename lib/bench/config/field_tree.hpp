#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/enum_text.hpp"
#include "base/fields.hpp"
#include "base/spec_json.hpp"

namespace avoidbench {

enum class FieldKind {
  truth,    ///< true or false
  whole,    ///< a whole number
  number,   ///< a finite number
  text,     ///< any text
  choice,   ///< one of several words
  list,     ///< a list of equal elements
  block,    ///< fields by name
  variant,  ///< a word that chooses which further fields stand beside it
  other,    ///< a key of the files that is no field of a spec: planners, include, preset
};

/// What a visit() says of one field, as plain data. The reader of files, the printer of defaults,
/// `config explain` and the JSON Schema all walk such a tree, so that they know every field there
/// is.
// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann::json says it of its own members
struct FieldTree {
  std::string name, doc;
  FieldKind kind = FieldKind::block;
  Range range;            ///< of numbers, also those in a list
  bool is_signed = true;  ///< of a whole number
  /// Of a choice; of a variant its kinds; of `preset` what is built in.
  std::vector<std::string> choices;
  std::vector<nlohmann::json> named;  ///< of `preset`: the blocks that its choices stand for
  std::optional<std::size_t> count;   ///< of a list, where it is fixed
  nlohmann::json preset;              ///< what it is where nothing is said; null for blocks
  /// Of a block; of a list one, its element; of a variant a block for each kind.
  std::vector<FieldTree> fields;
  /// Of a number that is 0 where it says nothing: the fields beside it that follow from it
  /// otherwise, and so can't be given with it.
  std::vector<std::string> settles;
  /// Of a key that is no field: how it is written.
  std::vector<std::pair<std::string, std::string>> facts;

  /// The field of this name in a block, or the kind of a variant; null if none.
  const FieldTree* find(std::string_view field) const;
};

bool is_number(const FieldTree& field);

/// The word of a variant that must be said for a field to be there: {"generator", "forest"}.
struct SaidKind {
  std::string path, kind;
};
struct KindField {
  std::string path;  ///< dotted, as are those of `kinds`, from the outermost block
  const FieldTree* field = nullptr;
  std::vector<SaidKind> kinds;
};

/// All fields below a block, in order, with all that its variants may add: a path may come several
/// times, from several kinds.
std::vector<KindField> all_fields(const FieldTree& block);

/// Those of one path: none where there is no such field.
std::vector<KindField> fields_at(const FieldTree& block, std::string_view path);

/// The block's JSON as spec_to_json() gives it for the spec that the tree was made of; with
/// `kinds`, for that of these kinds. `prefix` stands before the block's paths in `kinds`.
nlohmann::json preset_json(const FieldTree& block, const std::vector<SaidKind>& kinds = {},
                           const std::string& prefix = "");

/// The visitor of base/fields.hpp that makes the tree.
class FieldCollector {
 public:
  std::vector<FieldTree> fields;

  template <class T>
  void field(std::string_view name, const T& value, Range range, std::string_view doc) {
    fields.push_back(described(name, value, range, doc));
  }
  template <class T>
  void field(std::string_view name, const T& value, std::string_view doc) {
    field(name, value, Range{}, doc);
  }
  template <class Variant>
  void variant(std::string_view name, const Variant& value, std::string_view doc) {
    FieldTree tree;
    tree.name = name;
    tree.doc = doc;
    tree.kind = FieldKind::variant;
    tree.preset = std::string(kind(value));
    add_kinds<Variant, 0>(value, tree);
    fields.push_back(std::move(tree));
  }

  template <class T>
  static FieldTree described(std::string_view name, const T& value, Range range,
                             std::string_view doc) {
    FieldTree tree;
    tree.name = name;
    tree.doc = doc;
    tree.range = range;
    if constexpr (TextEnum<T>) {
      tree.kind = FieldKind::choice;
      tree.choices = enum_texts<T>();
    } else if constexpr (detail::IsSequence<T>::value) {
      tree.kind = FieldKind::list;
      if constexpr (!requires(T list) { list.resize(1); }) tree.count = value.size();
      const typename T::value_type element{};
      tree.fields.push_back(described("", element, range, ""));
    } else if constexpr (Visitable<const T, FieldCollector>) {
      FieldCollector inner;
      visit(inner, value);
      tree.fields = std::move(inner.fields);
      return tree;
    } else if constexpr (std::is_same_v<T, bool>) {
      tree.kind = FieldKind::truth;
    } else if constexpr (std::is_integral_v<T>) {
      tree.kind = FieldKind::whole;
      tree.is_signed = std::is_signed_v<T>;
      if (!tree.is_signed) tree.range.lowest = std::max(0.0, range.lowest);
    } else if constexpr (std::is_floating_point_v<T>) {
      tree.kind = FieldKind::number;
    } else {
      tree.kind = FieldKind::text;
    }
    tree.preset = detail::value_to_json(value);
    return tree;
  }

 private:
  template <class Variant, std::size_t index>
  static void add_kinds(const Variant& value, FieldTree& tree) {
    if constexpr (index < std::variant_size_v<Variant>) {
      using Kind = std::variant_alternative_t<index, Variant>;
      Kind held{};
      if (value.index() == index) held = std::get<index>(value);
      FieldTree block = described(Kind::kind, held, Range{}, "");
      if constexpr (requires { Kind::doc; }) block.doc = Kind::doc;
      tree.choices.push_back(block.name);
      tree.fields.push_back(std::move(block));
      add_kinds<Variant, index + 1>(value, tree);
    }
  }
};

/// The fields of `spec`, whose values are the presets.
template <class Spec>
FieldTree field_tree(std::string_view name, const Spec& spec, std::string_view doc) {
  return FieldCollector::described(name, spec, Range{}, doc);
}

}  // namespace avoidbench
