#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference/collision/search_study.hpp"

namespace lockstep {

/// How much the search finds in clouds at rest: a cube, a slab and a spherical shell, 50,000 and 200,000 particles,
/// seen from two distances, with three neighbourhood radii. Range 0.008 world units, CDT 500 x 500.
inline constexpr std::array<int, 3> recall_radii{1, 2, 4};

struct RecallRow {
    std::string cloud;
    std::size_t particles = 0;
    float distance = 0.0F;                                ///< of the camera, world units
    std::array<SearchCounts, recall_radii.size()> counts; ///< of each radius
};

/// Studies the start of `scenes`/cloud_{cube,slab,shell}.json; `on_row` after each row. Throws Error like load_scene.
std::vector<RecallRow> recall_table(const std::filesystem::path& scenes,
                                    const std::function<void(const RecallRow&)>& on_row = {});

/// What another model of the same clouds found (a floor texel rule, depth LESS, other random numbers), per cent.
struct ModelRecall {
    double visible;
    std::array<double, recall_radii.size()> recall;
    double true_nearest; ///< radius 4
    double non_mutual;   ///< radius 4
};
std::optional<ModelRecall> model_recall(const RecallRow& row);

std::string recall_table_head();
std::string recall_row_text(const RecallRow& row);
std::string recall_table_foot();

} // namespace lockstep
