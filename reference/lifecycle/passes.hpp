#pragma once
#include <memory>
#include <vector>

#include "reference/model/lifecycle/host.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::lifecycle {

using Passes = std::vector<std::unique_ptr<ItemPass>>;

// The passes of an emitter, in the order of a frame; each with what its dispatch writes besides.
void add_emit(Passes& all, const HostPtr& host, const HostEmitter& of);
void add_destroy(Passes& all, const HostPtr& host, const HostEmitter& of);
void add_move(Passes& all, const HostPtr& host, const HostEmitter& of);
void add_simulate(Passes& all, const HostPtr& host, const HostEmitter& of);
void add_post_destroy(Passes& all, const HostPtr& host, const HostEmitter& of);
void add_post_emit(Passes& all, const HostPtr& host, const HostEmitter& of);
void add_ribbon(Passes& all, const HostPtr& host, const HostEmitter& of);
void add_indirect(Passes& all, const HostPtr& host, const HostEmitter& of);

/// All of a frame, emitter after emitter.
Passes twins(const HostPtr& host);

} // namespace lockstep::lifecycle
