#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep {

class SystemSide;

/// Throws Error where a system cannot be run: no passes, a start that is none of its schema, a pass without items, a
/// mistake of a pass that there is not.
void check_system(const System& system);

/// The passes of one dispatch: `first`, and those that continue it.
std::size_t end_of_dispatch(const System& system, std::size_t first);

/// The buffers and images that the dispatch of pass `first` writes, each once.
std::vector<std::uint8_t> written_by(const System& system, std::size_t first);

/// A dispatch writes the buffers of its passes and no other, or this throws Error.
void expect_untouched(const System& system, std::size_t first, const SystemState& before, const SystemState& now,
                      int frame);

/// Throws Error where an item still holds what was laid there before its pass.
void find_canary(const ItemPass& pass, const SystemState& now, int frame);

/// What a dispatch reads of the buffers that it makes is another copy, which it leaves alone, or this throws Error.
/// Where nothing was made, the host may have left it out, and the other copy is none that was read.
void expect_left(const SystemSide& gpu, const System& system, std::size_t first, const SystemState& before,
                 const SystemState& now, int frame);

/// Whether the GPU surely left alone all that the dispatch of pass `first` does not write; `before(r)` has it.
bool holds_others(const SystemSide& gpu, const System& system, std::size_t first,
                  const std::function<View(std::uint8_t)>& before);

/// What a pass made, without the fields that cannot be otherwise on the GPU: those that are `before`'s own columns,
/// which the GPU held, and that its pass does not reach.
View without_kept(View made, const View& before, const SystemSide& gpu, std::size_t pass);

/// Throws Error where a reference changed a field that its pass says it keeps.
void expect_kept(const ItemPass& pass, const View& before, const View& made, int frame);

/// Gives a state, and the GPU, what is right of the buffers that are derived from others.
void put_right(SystemSide& gpu, SystemState& state, const SystemState& right, std::set<std::uint8_t>& wrong);

/// The GPU alone from the start, `work` after each dispatch with the state that it left; `pass` is its first. Of the
/// first two frames it proves what check() does: each buffer was written, no other changed, and the same state gives
/// the same bits. Throws Error where not. `work` returns whether to go on.
void run_gpu(const System& system, SystemSide& gpu, int frames,
             const std::function<bool(std::size_t pass, int frame, const SystemState& state)>& work);

} // namespace lockstep
