#include "reference/lights/passes.hpp"
#include "reference/lights/volume_twin.hpp"

namespace lockstep::lights {

void add_gather_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all) {
    const ArithmeticSwitch arithmetic = host->settings().arithmetic;
    const bool blended = blends(host->switches().accumulate);
    const auto options = [&](const char* name, std::uint8_t resource, PassStage stage, bool continues) {
        return ItemPassOptions{
            .name = name, .resource = resource, .stage = stage, .arithmetic = arithmetic, .continues = continues};
    };
    const PassStage stage = blended ? PassStage::fragment : PassStage::compute;
    if (!blended) {
        all.push_back(item_pass(options("light_sort_pass", cell_buffer, stage, false), CellTwin{host}));
        all.push_back(item_pass(options("light_sort_pass_lights", sorted_buffer, stage, true), SortTwin{host}));
    }
    const char* const name = blended ? "light_volume_blend" : "light_volume_gather";
    const char* const second = blended ? "light_volume_blend_direction" : "light_volume_gather_direction";
    all.push_back(item_pass(options(name, colour_image, stage, false), GatherTwin{host, Texture::colour}));
    all.push_back(item_pass(options(second, direction_image, stage, true), GatherTwin{host, Texture::direction}));
}

} // namespace lockstep::lights
