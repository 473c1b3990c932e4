#include "reference/fluid/by_driver.hpp"
#include "reference/fluid/passes.hpp"
#include "reference/fluid/shade_twin.hpp"
#include "reference/system/encode_twin.hpp"

namespace lockstep::fluid {

void add_shade_passes(const HostPtr& host, Passes& all) {
    all.push_back(by_filter(host, [](const HostPtr& by) {
        return item_pass(options_of(*by, "fluid_shade_pass", lit_image, PassStage::compute), ShadeTwin{by});
    }));
    const Encoding encoding = host->switches().encoding;
    const ItemPassOptions options = encoding == Encoding::srgb_hw
                                        ? options_of(*host, "encode_by_gl_pass", encoded_image, PassStage::fragment)
                                        : options_of(*host, "encode_pass", encoded_image, PassStage::compute);
    all.push_back(encode_pass(options, EncodeTwin{encoding, field::lit}));
}

} // namespace lockstep::fluid
