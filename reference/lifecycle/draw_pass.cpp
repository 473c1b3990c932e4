#include "reference/lifecycle/draw_pass.hpp"

#include <utility>
#include <vector>

#include "reference/lifecycle/draw_twin.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::lifecycle {
std::unique_ptr<ItemPass> draw_pass(const HostPtr& host, const Drawing& drawing) {
    std::vector<StageGraph> graphs;
    for (const HostEmitter& of : host->emitters())
        graphs.push_back(stage_graph(of.settings().rendering));
    return item_pass({.name = "draw",
                      .resource = corner_buffer,
                      .stage = PassStage::vertex,
                      .arithmetic = host->settings().arithmetic},
                     DrawTwin{host, drawing, std::move(graphs)});
}

} // namespace lockstep::lifecycle
