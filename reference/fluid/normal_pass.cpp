#include "reference/fluid/by_driver.hpp"
#include "reference/fluid/normal_twin.hpp"
#include "reference/fluid/passes.hpp"

namespace lockstep::fluid {

void add_normal_pass(const HostPtr& host, Passes& all) {
    all.push_back(by_filter(host, [](const HostPtr& by) {
        return item_pass(options_of(*by, "normal_pass", normal_image, PassStage::compute), NormalTwin{by});
    }));
}

} // namespace lockstep::fluid
