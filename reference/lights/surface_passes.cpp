#include "reference/lights/by_driver.hpp"
#include "reference/lights/lighting_twin.hpp"
#include "reference/lights/passes.hpp"

namespace lockstep::lights {

void add_surface_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all) {
    const ArithmeticSwitch arithmetic = host->settings().arithmetic;
    const auto lit = [&](const auto& made) {
        return host->switches().interpolation == Interpolation::trilinear_hw ? by_filter(host, made) : made(host);
    };
    const std::shared_ptr<const LatestTriangles> triangles = obstacle_triangles(*host);
    const auto drawn = [&](const char* name, std::uint8_t resource, Drawn image, bool continues) {
        const auto made = [&](const HostPtr& on) {
            return item_pass({.name = name,
                              .resource = resource,
                              .stage = PassStage::fragment,
                              .arithmetic = arithmetic,
                              .continues = continues},
                             DrawnTwin{on, image, triangles});
        };
        all.push_back(image == Drawn::lit ? lit(made) : made(host));
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
    all.push_back(lit([&](const HostPtr& on) {
        return item_pass({.name = "deferred_light_pass",
                          .resource = lit_image,
                          .stage = PassStage::compute,
                          .arithmetic = arithmetic},
                         DeferredTwin{on});
    }));
}

} // namespace lockstep::lights
