#include "reference/lights/lighting_twin.hpp"
#include "reference/lights/passes.hpp"

namespace lockstep::lights {

void add_surface_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all) {
    const ArithmeticSwitch arithmetic = host->settings().arithmetic;
    const auto drawn = [&](const char* name, std::uint8_t resource, Drawn image, bool continues) {
        all.push_back(item_pass({.name = name,
                                 .resource = resource,
                                 .stage = PassStage::fragment,
                                 .arithmetic = arithmetic,
                                 .continues = continues},
                                DrawnTwin{host, image}));
    };
    if (host->switches().pipeline == Pipeline::forward) {
        drawn("forward_light_pass", lit_image, Drawn::lit, false);
        drawn("forward_light_pass_depth", depth_image, Drawn::depth, true);
        return;
    }
    drawn("gbuffer_pass", position_image, Drawn::position, false);
    drawn("gbuffer_pass_normal", normal_image, Drawn::normal, true);
    drawn("gbuffer_pass_albedo", albedo_image, Drawn::albedo, true);
    drawn("gbuffer_pass_depth", depth_image, Drawn::depth, true);
    all.push_back(item_pass(
        {.name = "deferred_light_pass", .resource = lit_image, .stage = PassStage::compute, .arithmetic = arithmetic},
        DeferredTwin{host}));
}

} // namespace lockstep::lights
