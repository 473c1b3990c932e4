#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gpu/context.hpp"
#include "gpu/context_info.hpp"

namespace lockstep {

/// A known answer to a measured question: how many of the inputs it explains, and how far it is off on the others.
struct ProbeCandidate {
    std::string name;
    std::uint64_t matched = 0; ///< inputs with the same bits (two NaN are the same)
    std::int64_t max_ulp = 0; ///< largest distance on any input, INT64_MAX: NaN against a number; 0 where not of floats
};

inline constexpr std::string_view none_known = "none known";

/// One measured property of a driver.
struct ProbeRow {
    std::string name;    ///< "dot(vec3)", "dot(vec3), precise"
    std::string finding; ///< the first candidate that every input matches, or none_known
    std::uint64_t matched = 0;
    std::uint64_t total = 0;
    std::int64_t max_ulp = 0; ///< this and `matched`: the finding's, or those of the candidate that comes closest
    std::vector<ProbeCandidate> candidates;
};

/// What a driver was measured to compute where GL leaves it open.
struct ProbeResult {
    ContextInfo context;
    double seconds = 0.0;
    std::vector<ProbeRow> rows;

    /// Throws Error naming the row if there is none.
    [[nodiscard]] const ProbeRow& row(std::string_view name) const;
    [[nodiscard]] bool has(std::string_view name) const;
};

/// The candidate of that name. Throws Error naming both if the row has none.
const ProbeCandidate& candidate(const ProbeRow& row, std::string_view name);

struct ProbeOptions {
    std::size_t inputs = std::size_t{1} << 14U; ///< random inputs an arithmetic row
};

/// Measures `context`, which is current, through the stages the passes use: arithmetic in the vertex stage with
/// transform feedback and in the fragment stage, subnormals in the compute stage where there is one, points and
/// triangles into a float image behind a geometry stage. Throws Error without the GLSL qualifier `precise`.
ProbeResult probe(const Context& context, const ProbeOptions& options = {});

void to_json(nlohmann::json& json, const ProbeResult& result);
void from_json(const nlohmann::json& json, ProbeResult& result);

} // namespace lockstep
