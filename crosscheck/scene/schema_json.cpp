#include "crosscheck/scene/schema_json.hpp"

#include <nlohmann/json.hpp>

namespace lockstep {
namespace {

using nlohmann::json;

json field_json(const Field& field) {
    json out{{"name", field.name}, {"type", glsl_type(field)}, {"components", field.components}};
    if (!field.unit.empty())
        out["unit"] = field.unit;
    return out;
}

json resource_json(const Resource& resource) {
    json fields = json::array();
    for (const Field& field : resource.fields)
        fields.push_back(field_json(field));
    return {{"name", resource.name},
            {"item", resource.item},
            {"title", resource.title},
            {"dimensions", resource.dimensions},
            {"fields", fields}};
}

} // namespace

json schema_json(const Schema& schema) {
    json resources = json::array();
    for (const Resource& resource : schema.resources)
        resources.push_back(resource_json(resource));
    return {{"system", schema.system}, {"resources", resources}};
}

} // namespace lockstep
