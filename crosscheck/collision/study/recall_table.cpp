#include "crosscheck/collision/study/recall_table.hpp"

#include <fmt/format.h>

#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/scene/scene_file.hpp"

namespace lockstep {
namespace {

struct ModelRow {
    std::string_view cloud;
    std::size_t particles;
    float distance;
    ModelRecall model;
};

constexpr std::array model_rows{
    ModelRow{"cube", 50'000, 1.8F, {83.6, {40, 75, 83}, 81, 20}},
    ModelRow{"cube", 200'000, 1.8F, {53.8, {27, 50, 57}, 52, 43}},
    ModelRow{"cube", 200'000, 0.9F, {46.4, {9.5, 24, 43}, 41, 29}},
    ModelRow{"slab", 200'000, 1.8F, {46.9, {97, 99, 99}, 42, 72}},
    ModelRow{"shell", 200'000, 1.8F, {38.5, {83, 87, 87}, 34, 73}},
    ModelRow{"shell", 200'000, 0.9F, {36.7, {39, 43, 44}, 34, 48}},
};

} // namespace

std::vector<RecallRow> recall_table(const std::filesystem::path& scenes,
                                    const std::function<void(const RecallRow&)>& on_row) {
    std::vector<RecallRow> rows;
    for (const std::string cloud : {"cube", "slab", "shell"})
        for (const std::size_t particles : {50'000U, 200'000U}) {
            SceneOptions options;
            options.particles = particles;
            Scene scene = load_scene(scenes / ("cloud_" + cloud + ".json"), options);
            const TrueNeighbours truth = find_truth(scene.start.position, scene.constants.collision_range);
            for (const float distance : {1.8F, 0.9F}) {
                scene.camera.eye.z = distance;
                RecallRow row{cloud, particles, distance, {}};
                for (std::size_t r = 0; r < recall_radii.size(); ++r) {
                    scene.constants.texel_collide_range = recall_radii[r];
                    row.counts[r] = study_start(scene, truth, Profile{}).counts;
                }
                rows.push_back(row);
                if (on_row)
                    on_row(row);
            }
        }
    return rows;
}

std::optional<ModelRecall> model_recall(const RecallRow& row) {
    for (const ModelRow& known : model_rows)
        if (known.cloud == row.cloud && known.particles == row.particles && known.distance == row.distance)
            return known.model;
    return {};
}

std::string recall_table_head() {
    return fmt::format("{:<6} {:>9} {:>8} {:>8}  {:^17}  {:^17}  {:^17}  {:>7} {:>7}  {}\n"
                       "{:<6} {:>9} {:>8} {:>8}  {:^17}  {:^17}  {:^17}  {:>7} {:>7}  {}\n",
                       "cloud", "particles", "distance", "visible", "recall %", "counting the base", "on the image",
                       "nearest", "not mut", "another model: visible; recall; nearest, not mutual", "", "", "", "%",
                       "radius 1 / 2 / 4", "texel as well", "only", "r = 4", "r = 4", "");
}

std::string recall_row_text(const RecallRow& row) {
    const auto three = [&](double (SearchCounts::*value)() const) {
        return fmt::format("{:5.1f} {:5.1f} {:5.1f}", 100.0 * (row.counts[0].*value)(),
                           100.0 * (row.counts[1].*value)(), 100.0 * (row.counts[2].*value)());
    };
    const SearchCounts& widest = row.counts.back();
    std::string text = fmt::format(
        "{:<6} {:>9} {:>8} {:>8.1f}  {}  {}  {}  {:>7.1f} {:>7.1f}", row.cloud, row.particles, row.distance,
        100.0 * static_cast<double>(widest.owners) / static_cast<double>(row.particles), three(&SearchCounts::recall),
        three(&SearchCounts::recall_with_base), three(&SearchCounts::recall_inside), 100.0 * widest.true_nearest(),
        100.0 * widest.non_mutual_rate());
    if (const auto model = model_recall(row))
        text += fmt::format("  {}; {} / {} / {}; {}, {}", model->visible, model->recall[0], model->recall[1],
                            model->recall[2], model->true_nearest, model->non_mutual);
    return text + "\n";
}

std::string recall_table_foot() {
    return "Recall: of the particles with an exact neighbour within the range, those that find one in the CDT.\n"
           "Visible: particles that own a texel. The listing skips the base texel (line 12), and so does the "
           "reference,\n"
           "which then misses the very particle that hides the searcher; counting it comes closest to the other "
           "model.\n";
}

} // namespace lockstep
