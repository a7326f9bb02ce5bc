#include "config/field_tree.hpp"

namespace avoidbench {
namespace {

void add_fields(const FieldTree& block, const std::string& prefix,
                const std::vector<SaidKind>& kinds, std::vector<KindField>& all) {
  for (const FieldTree& field : block.fields) {
    const std::string path = prefix + field.name;
    all.push_back({path, &field, kinds});
    if (field.kind == FieldKind::block) add_fields(field, path + ".", kinds, all);
    if (field.kind != FieldKind::variant) continue;
    // A kind's fields stand beside the variant, not below it.
    for (const FieldTree& of_kind : field.fields) {
      std::vector<SaidKind> said = kinds;
      said.push_back({path, of_kind.name});
      add_fields(of_kind, prefix, said, all);
    }
  }
}

}  // namespace

const FieldTree* FieldTree::find(std::string_view field) const {
  for (const FieldTree& other : fields) {
    if (other.name == field) return &other;
  }
  return nullptr;
}

bool is_number(const FieldTree& field) {
  return field.kind == FieldKind::number || field.kind == FieldKind::whole;
}

std::vector<KindField> all_fields(const FieldTree& block) {
  std::vector<KindField> all;
  add_fields(block, "", {}, all);
  return all;
}

std::vector<KindField> fields_at(const FieldTree& block, std::string_view path) {
  std::vector<KindField> found = all_fields(block);
  std::erase_if(found, [&](const KindField& entry) { return entry.path != path; });
  return found;
}

nlohmann::json preset_json(const FieldTree& block, const std::vector<SaidKind>& kinds,
                           const std::string& prefix) {
  nlohmann::json json = nlohmann::json::object();
  for (const FieldTree& field : block.fields) {
    const std::string path = prefix + field.name;
    if (field.kind == FieldKind::block) {
      json[field.name] = preset_json(field, kinds, path + ".");
    } else if (field.kind != FieldKind::other) {
      json[field.name] = field.preset;
    }
    if (field.kind != FieldKind::variant) continue;
    // The kind that was said, else the default; only its fields come with it.
    for (const SaidKind& said : kinds) {
      if (said.path == path) json[field.name] = said.kind;
    }
    for (const FieldTree& of_kind : field.fields) {
      if (json[field.name] == of_kind.name) json.update(preset_json(of_kind, kinds, prefix));
    }
  }
  return json;
}

}  // namespace avoidbench
