#include "reference/lights/by_driver.hpp"
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
    const auto add = [&](const ItemPassOptions& one, Texture texture) {
        const auto made = [&](const HostPtr& on) { return item_pass(one, GatherTwin{on, texture}); };
        const bool halves = host->switches().volume_format == Format::rgba16f;
        all.push_back(blended ? by_driver(halves ? half_blend_row : float_blend_row, host, made) : made(host));
    };
    add(options(name, colour_image, stage, false), Texture::colour);
    add(options(second, direction_image, stage, true), Texture::direction);
}

} // namespace lockstep::lights
