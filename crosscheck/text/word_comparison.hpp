#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crosscheck/text/bound_stage.hpp"
#include "crosscheck/text/made_up_world.hpp"
#include "reference/known_operations.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep {

/// A word that a text makes, and what something else made.
struct ComparedWord {
    text::WrittenPlace place;
    std::optional<std::uint32_t> invocation; ///< the one that wrote it last in the text, where it did
    std::uint32_t expected = 0, got = 0;
};

/// The words of one block, image or output: what a text makes of them, and what something else made.
struct ComparedWords {
    text::WrittenPlace place; ///< of the first; outputs of one invocation are behind those of the invocation before
    std::span<const std::uint32_t> expected, got;
    std::span<const std::uint32_t> writers; ///< in the text, as Writers has them; empty: not known, or of an output
    std::uint32_t cells = 0;                ///< of an output in one invocation, or of a vertex that one emits
    std::span<const std::uint32_t> emitted_by = {}; ///< of a geometry stage: each vertex's invocation

    [[nodiscard]] ComparedWord word(std::size_t number) const;
};

/// Storage blocks and images of a program. `got`: what something else made of MadeUpWorld::words.
std::vector<ComparedWords> compared_words(const text::Program& program, const MadeUpWorld& expected,
                                          const text::Writers& writers,
                                          std::span<const std::span<const std::uint32_t>> got);

/// Words that something made beside those that a text allows.
struct WordComparison {
    std::size_t words = 0;
    std::size_t differing = 0;          ///< from the text's bits
    std::size_t legal = 0;              ///< of these, in the sets that the text leaves open
    std::vector<ComparedWord> wrong;    ///< those that are in no set
    std::vector<ComparedWord> unjudged; ///< of invocations that are not followed by sets
    std::string unjudged_for;           ///< why, of the first
};

/// How the text's invocations are judged: in which stage, and what is known of what computes the other side.
struct JudgedBy {
    PassStage stage = PassStage::compute;
    KnownOperations known = {};
    std::size_t most = 2000;  ///< invocations; those of the rest are not judged
    bool judges = true;       ///< false: what differs is counted alone
    std::string why_not = {}; ///< no invocation is followed by sets; empty: those are that may be
};

/// Compares all words with what `text` makes; what one invocation wrote has to lie in one of its outcomes together.
WordComparison compare_words(const BoundStage& text, std::span<const ComparedWords> all, const JudgedBy& by);

/// The first word of each invocation, `most` of them.
std::vector<ComparedWord> first_of_each(std::span<const ComparedWord> words, std::size_t most);

/// "expected 3.9 (0x4079999a), OTHER 5.8 (0x40b9999a)"; `other`: what made the other.
std::string both_values(const ComparedWord& word, bool is_real, std::string_view other);

} // namespace lockstep
