#pragma once
#include <utility>

#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// CollisionCode::driver_codes, as narrow as the probe measured the driver's conversion (paired_rows.hpp): between
/// these lie the codes of a position between `low` and `high`.
std::pair<glm::vec4, glm::vec4> measured_codes(const FrameParams& params, glm::vec3 low, glm::vec3 high,
                                               const Profile& profile);

} // namespace lockstep
