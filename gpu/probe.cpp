#include "gpu/probe.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/shader_object.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

const ProbeRow& ProbeResult::row(std::string_view name) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const ProbeRow& row) { return row.name == name; });
    if (found == rows.end())
        throw Error(fmt::format("probe: there is no row '{}'", name));
    return *found;
}

bool ProbeResult::has(std::string_view name) const {
    return std::any_of(rows.begin(), rows.end(), [&](const ProbeRow& row) { return row.name == name; });
}

const ProbeCandidate& candidate(const ProbeRow& row, std::string_view name) {
    const auto found = std::find_if(row.candidates.begin(), row.candidates.end(),
                                    [&](const ProbeCandidate& candidate) { return candidate.name == name; });
    if (found == row.candidates.end())
        throw Error(fmt::format("probe: row '{}' has no candidate '{}'", row.name, name));
    return *found;
}

ProbeResult probe(const Context& context, const ProbeOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    ProbeResult result;
    result.context = context.describe();
    if (!result.context.precise)
        throw Error("probe: the context's GLSL has no `precise`; GL 4.0 or GL_ARB_gpu_shader5 has");
    const probing::DriverArithmetic plain(false), precise(true);
    probing::measure_vertex_arithmetic(plain, precise, options.inputs, result.rows);
    if (takes_spirv())
        probing::measure_module_arithmetic(precise, options.inputs, result.rows);
    probing::measure_chains(precise, result.rows);
    probing::measure_sines(result.rows);
    probing::measure_fragment_arithmetic(result.rows);
    if (result.context.compute) {
        probing::measure_compute_arithmetic(precise, result.rows);
        probing::measure_compute_chains(precise, result.rows);
        probing::measure_compute_sines(result.rows);
    }
    probing::measure_storage(result.rows);
    if (result.context.compute)
        probing::measure_image_store(result.rows);
    probing::measure_blending(result.rows);
    probing::measure_filtering(result.rows);
    probing::measure_srgb(result.rows);
    probing::measure_point_coord(result.rows);
    probing::measure_points_outside(result.rows);
    if (result.context.compute)
        probing::measure_atomics(result.rows);
    probing::measure_order(result.rows);
    probing::measure_snapping(result.rows);
    probing::measure_viewport(plain, result.rows);
    probing::measure_depth(plain, result.rows);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

void to_json(nlohmann::json& json, const ProbeCandidate& candidate) {
    json = {{"name", candidate.name}, {"matched", candidate.matched}, {"max_ulp", candidate.max_ulp}};
}

void from_json(const nlohmann::json& json, ProbeCandidate& candidate) {
    json.at("name").get_to(candidate.name);
    json.at("matched").get_to(candidate.matched);
    json.at("max_ulp").get_to(candidate.max_ulp);
}

void to_json(nlohmann::json& json, const ProbeRow& row) {
    json = {{"name", row.name},   {"finding", row.finding}, {"matched", row.matched},
            {"total", row.total}, {"max_ulp", row.max_ulp}, {"candidates", row.candidates}};
}

void from_json(const nlohmann::json& json, ProbeRow& row) {
    json.at("name").get_to(row.name);
    json.at("finding").get_to(row.finding);
    json.at("matched").get_to(row.matched);
    json.at("total").get_to(row.total);
    json.at("max_ulp").get_to(row.max_ulp);
    json.at("candidates").get_to(row.candidates);
}

void to_json(nlohmann::json& json, const ProbeResult& result) {
    json = {{"context", result.context}, {"seconds", result.seconds}, {"rows", result.rows}};
}

void from_json(const nlohmann::json& json, ProbeResult& result) {
    json.at("context").get_to(result.context);
    json.at("seconds").get_to(result.seconds);
    json.at("rows").get_to(result.rows);
}

} // namespace lockstep
