#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/probe.hpp"
#include "reference/model/error.hpp"
#include "reference/model/ulp.hpp"

namespace lockstep::probing {

using Floats = std::vector<float>;

/// What a candidate predicts, value for value.
template <class Value> struct Prediction {
    std::string name;
    std::vector<Value> values;
};

/// The row that results when `measured` is held against each prediction; the earlier one wins where several match.
/// Throws Error if there is nothing to judge.
template <class Value> ProbeRow judge(std::string name, const std::vector<Value>& measured,
                                      const std::vector<Prediction<std::type_identity_t<Value>>>& predictions) {
    ProbeRow row;
    row.name = std::move(name);
    row.total = measured.size();
    const auto fits = [&](const auto& prediction) { return prediction.values.size() == measured.size(); };
    if (measured.empty() || predictions.empty() || !std::all_of(predictions.begin(), predictions.end(), fits))
        throw Error("probe: row '" + row.name + "' has nothing to be judged by");
    for (const auto& prediction : predictions) {
        ProbeCandidate candidate{prediction.name, 0, 0};
        for (std::size_t i = 0; i < measured.size(); ++i) {
            if constexpr (std::is_same_v<Value, float>) {
                candidate.matched += same_bits(measured[i], prediction.values[i]) ? 1 : 0;
                candidate.max_ulp = std::max(candidate.max_ulp, ulp_distance(measured[i], prediction.values[i]));
            } else {
                candidate.matched += measured[i] == prediction.values[i] ? 1 : 0;
            }
        }
        row.candidates.push_back(std::move(candidate));
    }
    const auto fewer = [](const ProbeCandidate& a, const ProbeCandidate& b) { return a.matched < b.matched; };
    const auto best = std::max_element(row.candidates.begin(), row.candidates.end(), fewer);
    row.matched = best->matched;
    row.max_ulp = best->max_ulp;
    row.finding = best->matched == row.total ? best->name : std::string(none_known);
    return row;
}

} // namespace lockstep::probing
