#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "reference/collision/search_study.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What the remedies find and what they cost (docs/remedies.md): the cube cloud at rest, range 0.008, CDT 500 x 500,
/// radius 4; the first row is the listing's own pass.

/// What the GL frame of a row takes: every particle searches, the CDT was drawn the frame before.
struct RemedyCost {
    double frame = 0.0;  ///< seconds, median, to glFinish
    double timer = 0.0;  ///< the same by the GPU's own clock
    double single = 0.0; ///< of the first row's frames, run in turn with these
    bool agrees = false; ///< reference and GPU, three frames, every bit

    [[nodiscard]] double times_single() const { return frame / single; }
};

/// Momentum in a step of a moving cube: pairs whose particles have no other neighbour, and both answer.
struct PairMomentum {
    std::size_t pairs = 0;
    double worst = 0.0; ///< |change of the sum| / sum of |momentum| before
};

struct RemedyRow {
    std::vector<std::pair<std::string, std::string>> switches; ///< off their first value
    SearchCounts counts;
    std::optional<RemedyCost> cost;       ///< where there is a GL
    std::optional<PairMomentum> momentum; ///< response = mutual: the reference's, or the GPU's where there is one

    [[nodiscard]] std::string name() const;
};

struct RemedyOptions {
    std::filesystem::path scenes, shaders;
    std::size_t particles = 200'000;
    int frames = 15; ///< timed, of each row
    bool gl = false; ///< a context is current
    Profile profile;
    std::function<void(const RemedyRow&)> on_row;
};

std::vector<RemedyRow> remedy_table(const RemedyOptions& options);

std::string remedy_head();
std::string remedy_text(const RemedyRow& row);
nlohmann::json remedy_json(const std::vector<RemedyRow>& rows);

} // namespace lockstep
