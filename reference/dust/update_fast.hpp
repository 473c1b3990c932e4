#pragma once
#include <cstddef>
#include <vector>

#include "reference/model/dust/host.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::dust {

/// Whether update_fast has what the host's settings ask of Update.
bool has_update_fast(const Host& host);

/// Update on vectors, with the twin's bits: the flight of grains first to last, the last excluded, into `after`. Those
/// that come to a wall or a collider are not written; `left` gets their numbers. `after` may be what `in` reads.
void update_fast(const Host& host, const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
                 const WritableView& after, std::vector<std::size_t>& left);

} // namespace lockstep::dust
