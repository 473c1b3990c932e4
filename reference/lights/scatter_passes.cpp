#include "reference/lights/passes.hpp"
#include "reference/lights/volume_twin.hpp"

namespace lockstep::lights {

void add_scatter_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all) {
    const ArithmeticSwitch arithmetic = host->settings().arithmetic;
    const auto options = [&](const char* name, std::uint8_t resource, bool continues) {
        return ItemPassOptions{.name = name,
                               .resource = resource,
                               .stage = PassStage::compute,
                               .arithmetic = arithmetic,
                               .continues = continues};
    };
    all.push_back(item_pass(options("light_volume_clear", accumulator_image, false), ClearTwin{host}));
    ItemPassOptions scatter = options("light_volume_scatter", accumulator_image, false);
    scatter.unordered = adds_floats(host->switches().accumulate);
    all.push_back(item_pass(std::move(scatter), ScatterTwin{host}));
    all.push_back(item_pass(options("light_volume_resolve", colour_image, false), ResolveTwin{host, Texture::colour}));
    all.push_back(item_pass(options("light_volume_resolve_direction", direction_image, true),
                            ResolveTwin{host, Texture::direction}));
}

} // namespace lockstep::lights
