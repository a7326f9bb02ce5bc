#include "config/field_tree.hpp"

namespace avoidbench {
namespace {

void add_fields(const FieldTree& block, const std::string& variant, const std::string& kind,
                std::vector<KindField>& all) {
  for (const FieldTree& field : block.fields) {
    all.push_back({&field, variant, kind});
    if (field.kind != FieldKind::variant) continue;
    for (const FieldTree& of_kind : field.fields) {
      add_fields(of_kind, field.name, of_kind.name, all);
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

std::vector<KindField> all_fields(const FieldTree& block) {
  std::vector<KindField> all;
  add_fields(block, "", "", all);
  return all;
}

std::vector<KindField> fields_at(const FieldTree& block, std::string_view path) {
  const std::size_t dot = path.find('.');
  std::vector<KindField> found;
  for (const KindField& entry : all_fields(block)) {
    if (entry.field->name != path.substr(0, dot)) continue;
    if (dot == std::string_view::npos) {
      found.push_back(entry);
    } else if (entry.field->kind == FieldKind::block) {
      for (KindField& inner : fields_at(*entry.field, path.substr(dot + 1))) {
        if (inner.kind.empty()) {
          inner.variant = entry.variant;
          inner.kind = entry.kind;
        }
        found.push_back(std::move(inner));
      }
    }
  }
  return found;
}

nlohmann::json preset_json(const FieldTree& block) {
  nlohmann::json json = nlohmann::json::object();
  for (const FieldTree& field : block.fields) {
    json[field.name] = field.kind == FieldKind::block ? preset_json(field) : field.preset;
    if (field.kind != FieldKind::variant) continue;
    for (const FieldTree& of_kind : field.fields) {
      if (of_kind.name == field.preset) json.update(preset_json(of_kind));
    }
  }
  return json;
}

}  // namespace avoidbench
