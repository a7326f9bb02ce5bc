#include "config/field_tree.hpp"

namespace avoidbench {
namespace {

void add_fields(const FieldTree& block, const std::vector<SaidKind>& kinds,
                std::vector<KindField>& all) {
  for (const FieldTree& field : block.fields) {
    all.push_back({&field, kinds});
    if (field.kind != FieldKind::variant) continue;
    // A kind's fields stand beside the variant, not below it.
    for (const FieldTree& of_kind : field.fields) {
      std::vector<SaidKind> said = kinds;
      said.push_back({field.name, of_kind.name});
      add_fields(of_kind, said, all);
    }
  }
}

nlohmann::json json_below(const FieldTree& block, const std::string& prefix,
                          const std::vector<SaidKind>& kinds) {
  nlohmann::json json = nlohmann::json::object();
  for (const FieldTree& field : block.fields) {
    const std::string path = prefix + field.name;
    if (field.kind == FieldKind::block) {
      json[field.name] = json_below(field, path + ".", kinds);
    } else if (field.kind != FieldKind::other) {
      json[field.name] = field.preset;
    }
    if (field.kind != FieldKind::variant) continue;
    // The kind that was said, else the default; only its fields come with it.
    for (const SaidKind& said : kinds) {
      if (said.path == path) json[field.name] = said.kind;
    }
    for (const FieldTree& of_kind : field.fields) {
      if (json[field.name] == of_kind.name) json.update(json_below(of_kind, prefix, kinds));
    }
  }
  return json;
}

}  // namespace

std::string listed(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

const FieldTree* FieldTree::find(std::string_view field) const {
  for (const FieldTree& other : fields) {
    if (other.name == field) return &other;
  }
  return nullptr;
}

std::vector<KindField> all_fields(const FieldTree& block) {
  std::vector<KindField> all;
  add_fields(block, {}, all);
  return all;
}

std::vector<KindField> fields_at(const FieldTree& block, std::string_view path) {
  const std::size_t dot = path.find('.');
  const std::string first(path.substr(0, dot));
  std::vector<KindField> found;
  for (const KindField& entry : all_fields(block)) {
    if (entry.field->name != first) continue;
    if (dot == std::string_view::npos) {
      found.push_back(entry);
    } else if (entry.field->kind == FieldKind::block) {
      for (const KindField& inner : fields_at(*entry.field, path.substr(dot + 1))) {
        KindField whole = entry;
        whole.field = inner.field;
        // Paths of kinds count from the outermost block.
        for (const SaidKind& said : inner.kinds) {
          whole.kinds.push_back({first + "." + said.path, said.kind});
        }
        found.push_back(std::move(whole));
      }
    }
  }
  return found;
}

nlohmann::json preset_json(const FieldTree& block, const std::vector<SaidKind>& kinds) {
  return json_below(block, "", kinds);
}

}  // namespace avoidbench
