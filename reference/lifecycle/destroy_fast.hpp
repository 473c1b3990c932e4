#pragma once
#include <vector>

#include "reference/model/lifecycle/host.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::lifecycle {

/// The list of survivors, items first to last, as DestroyTwin and AppendTwin make it item by item, in one walk.
void destroy_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                  const WritableView& after);

/// The items of the list that are appended.
ItemRange survivors_of(const Host& host, const HostEmitter& of, const PassInput& in);

/// The same of the dead, where they are listed.
void bury_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
               const WritableView& after);
ItemRange dead_of(const Host& host, const HostEmitter& of, const PassInput& in);

} // namespace lockstep::lifecycle
