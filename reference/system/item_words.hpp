#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "reference/interval.hpp"

namespace lockstep {

/// An integer of which a reading of sets knows more than its value.
struct LegalWord {
    std::uint32_t word = 0;
    Interval set; ///< as doubles, of the field's type
    [[nodiscard]] const Interval& legal() const { return set; }
    static LegalWord exactly(std::uint32_t word) {
        return {word, {static_cast<double>(word), static_cast<double>(word)}};
    }
};

/// What a twin returns of items whose fields are known at run time alone: word after word, each a number of the reading
/// R or bits that are copied as they are.
template <class R> class ItemWords {
  public:
    static constexpr std::size_t most = 32;

    void add(const typename R::Real& number) { words_[size_++] = {number, 0, Kind::number, {}}; }
    void add(std::uint32_t bits) { words_[size_++] = {{}, bits, Kind::bits, {}}; }
    /// An integer of the field's type, and those that it may legally be.
    void add(const LegalWord& word) { words_[size_++] = {{}, 0, Kind::word, word}; }

    [[nodiscard]] std::size_t size() const { return size_; }
    template <class Visit> void for_each(const Visit& visit) const {
        for (std::size_t w = 0; w < size_; ++w)
            if (words_[w].kind == Kind::number)
                visit(words_[w].number);
            else if (words_[w].kind == Kind::word)
                visit(words_[w].word);
            else
                visit(words_[w].bits);
    }

  private:
    enum class Kind : std::uint8_t { number, bits, word };
    struct Word {
        typename R::Real number;
        std::uint32_t bits;
        Kind kind;
        LegalWord word;
    };
    std::array<Word, most> words_{};
    std::size_t size_ = 0;
};

} // namespace lockstep
