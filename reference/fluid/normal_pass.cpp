#include "reference/fluid/normal_twin.hpp"
#include "reference/fluid/passes.hpp"

namespace lockstep::fluid {

void add_normal_pass(const HostPtr& host, Passes& all) {
    all.push_back(item_pass(options_of(*host, "normal_pass", normal_image, PassStage::compute),
                            NormalTwin{host, pixel_places(*host)}));
}

} // namespace lockstep::fluid
