#pragma once
#include <cstddef>
#include <vector>

#include "reference/model/lifecycle/host.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::lifecycle {

/// Whether moving and simulating an emitter's particles has a way on vectors: particles of halves that nothing but
/// their own acceleration moves.
bool has_move_fast(const Host& host, const HostEmitter& of);

/// Whether `move` leaves every particle of the emitter in its slot, as none of them may die.
bool nothing_moves(const Host& host, const HostEmitter& of, const PassInput& in);

/// Makes items first to last of `move`, with the bits of MoveTwin; survivors of those that may die are put into `left`.
void move_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
               const WritableView& after, std::vector<std::size_t>& left);

/// Likewise of `simulate`, with the bits of SimulateTwin.
void simulate_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                   const WritableView& after);

/// Likewise of `emit`: newborns are put into `left`, all others stay.
void emit_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
               const WritableView& after, std::vector<std::size_t>& left);

/// The same of index lists: the newborns' slots, and the list that they go behind.
void emit_listed_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                      const WritableView& after, std::vector<std::size_t>& left);
void emit_list_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                    const WritableView& after, std::vector<std::size_t>& left);

} // namespace lockstep::lifecycle
