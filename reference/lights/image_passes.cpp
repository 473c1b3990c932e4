#include "reference/lights/by_driver.hpp"
#include "reference/lights/glow_twin.hpp"
#include "reference/lights/passes.hpp"
#include "reference/system/encode_twin.hpp"

namespace lockstep::lights {

void add_image_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all) {
    const ArithmeticSwitch arithmetic = host->settings().arithmetic;
    if (host->switches().glow == OffOn::on)
        all.push_back(by_driver(float_blend_row, host, [&](const HostPtr& on) {
            return item_pass(
                {.name = "glow_pass", .resource = lit_image, .stage = PassStage::fragment, .arithmetic = arithmetic},
                GlowTwin{on});
        }));
    const bool by_gl = host->switches().encoding == Encoding::srgb_hw;
    const auto encode = [&](const HostPtr& on) {
        return lockstep::encode_pass({.name = by_gl ? "encode_by_gl_pass" : "encode_pass",
                                      .resource = encoded_image,
                                      .stage = by_gl ? PassStage::fragment : PassStage::compute,
                                      .arithmetic = arithmetic},
                                     EncodeTwin{on->switches().encoding, field::pixel, on->follows_driver()});
    };
    all.push_back(by_gl ? by_driver(srgb_row, host, encode) : encode(host));
}

} // namespace lockstep::lights
