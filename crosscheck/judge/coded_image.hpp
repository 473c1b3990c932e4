#pragma once
#include "reference/model/image.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep {

/// The picture that an image of codes from 0 to 255 is: three components or more, the last ones ignored.
ColorImage coded_image(const SystemState& state, FieldId codes);

} // namespace lockstep
