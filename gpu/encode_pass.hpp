#pragma once
#include <cstdint>

#include "gpu/gl_pass_list.hpp"
#include "reference/model/srgb_table.hpp"

namespace lockstep {

/// The pass that makes codes of 8 bits of the image `lit`: encode_pass, or encode_by_gl_pass where GL encodes.
/// `encoded`: that image; `any_buffer`: one that the schema has.
void add_encode_pass(Encoding encoding, std::uint8_t encoded, std::uint8_t any_buffer, GlPassList& all);

} // namespace lockstep
