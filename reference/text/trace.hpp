#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reference/model/profile.hpp"
#include "reference/text/invocation.hpp"
#include "reference/text/program.hpp"

namespace lockstep::text {

struct Bindings;

/// What an operation took: the row that made it, and its bits.
struct TraceOperand {
    static constexpr std::uint32_t no_row = 0xffffffffU; ///< a constant, a uniform, a built-in input
    std::uint32_t row = no_row, bits = 0;
};

/// A scalar that an invocation made, or a word that it read or wrote.
struct TraceRow {
    enum class Kind : std::uint8_t { operation, comparison, load, store };
    Kind kind = Kind::operation;
    bool is_real = false;
    std::uint16_t op = 0; ///< of the step
    std::uint32_t step = 0, line = 0;
    std::uint32_t bits = 0;             ///< a comparison's: 0 or 1
    std::uint32_t first = 0, count = 0; ///< operands; a store's first is what it writes
    WrittenPlace place;                 ///< of loads and stores
    std::uint32_t calls = 0;            ///< Trace::calls, from 1; 0: the main function
};

/// A scalar of a variable that was set.
struct TraceSetting {
    std::uint32_t rows = 0; ///< how many there were
    std::uint32_t step = 0, cell = 0, bits = 0;
};

/// What one invocation came by, in order.
struct Trace {
    std::vector<TraceRow> rows;
    std::vector<TraceOperand> operands;
    bool notes_settings = false; ///< asked for
    std::vector<TraceSetting> settings;
    struct Call {
        std::uint32_t step = 0, outer = 0; ///< of the call, and the call around it
    };
    std::vector<Call> calls;

    [[nodiscard]] std::span<const TraceOperand> of(const TraceRow& row) const {
        return std::span(operands).subspan(row.first, row.count);
    }
};

/// The lines that lead to a row, its own first, then those of the calls around it.
std::vector<std::uint32_t> lines_of(const Program& program, const Trace& trace, const TraceRow& row);

/// The number that a word is.
std::string value_text(std::uint32_t bits, bool is_real);

/// A row that gets other bits than it was made with. `turned`: from this row on each comparison of its step gets the
/// other answer.
struct ForcedRow {
    std::uint32_t row = 0, bits = 0;
    std::optional<std::uint32_t> turned = {}; ///< the step
};

/// A word that an invocation wrote.
struct TracedWord {
    WrittenPlace place;
    std::uint32_t bits = 0;
    friend bool operator==(const TracedWord&, const TracedWord&) = default;
};

/// Runs an invocation that shares nothing with others but what it reads. `inputs`: of another stage than compute. What
/// `bindings` name stays as it is. Returns what it wrote, in the order of places. Throws Error by FILE:LINE for what is
/// not run so.
std::vector<TracedWord> run_traced(const Program& program, const Invocation& invocation,
                                   std::array<std::uint32_t, 3> groups, const Bindings& bindings,
                                   const Profile& profile, std::span<const ForcedRow> forced, Trace& trace,
                                   std::span<const GivenInput> inputs = {});

} // namespace lockstep::text
