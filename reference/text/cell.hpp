#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "reference/interval.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/readings/values.hpp"
#include "reference/text/invocation.hpp"
#include "reference/text/word_range.hpp"
#include "reference/undefined.hpp"

namespace lockstep::text {

/// The reading of bits, with the words that a text has and twins have not.
class TextValues : public Values<PlainArithmetic> {
  public:
    explicit TextValues(const Profile& profile)
        : Values<PlainArithmetic>(PlainArithmetic(profile)), length_(profile.length_order()),
          normalize_(profile.normalize_order()) {}

    [[nodiscard]] Real inverse_sqrt(At, Real a) const { return fp_.inverse_sqrt(a); }
    // The orders of sums of other than three products, which a text alone has.
    [[nodiscard]] DotOrder dot_order() const { return fp_.dot_order(); }
    [[nodiscard]] DotOrder length_order() const { return length_; }
    [[nodiscard]] DotOrder normalize_order() const { return normalize_; }
    /// A component of normalize, of a vector whose dot product with itself is known.
    [[nodiscard]] Real part_of_unit(At, Real component, Real squared) const {
        return fp_.direction_of({component, 0.0F, 0.0F}, squared).x;
    }
    static Real fma(At, Real a, Real b, Real c) { return std::fma(a, b, c); }
    /// Not an unsigned conversion of negative numbers, which GLSL leaves undefined (GLSL 4.60, 5.4.1).
    static std::uint32_t to_int(At, Real x) { return static_cast<std::uint32_t>(truncated(x)); }
    static std::uint32_t to_uint(At, Real x) { return static_cast<std::uint32_t>(truncated(x)); }

  private:
    static std::int64_t truncated(float x) {
        constexpr float most = 0x1p62F;
        return x > -most && x < most ? static_cast<std::int64_t>(x) : 0;
    }
    DotOrder length_, normalize_;
};

/// The reading of bits of an invocation whose every operation is noted (machine_trace.hpp).
class TracedValues : public TextValues {
  public:
    using TextValues::TextValues;
};

class TextWorlds;
/// A reading whose numbers are sets.
template <class R> inline constexpr bool has_sets = false;
template <> inline constexpr bool has_sets<TextWorlds> = true;
template <class R> inline constexpr bool is_traced = false;
template <> inline constexpr bool is_traced<TracedValues> = true;
/// Whether it runs one invocation again and again, and keeps what this writes beside memory, which stays as it is.
template <class R> inline constexpr bool runs_apart = has_sets<R> || is_traced<R>;

/// One scalar of one invocation. Of bits alone a word is enough; sets have a number of theirs beside it, and words that
/// come of one's bits may be many.
template <class R> struct Cell {
    std::uint32_t w = 0;

    [[nodiscard]] float real() const { return std::bit_cast<float>(w); }
    [[nodiscard]] std::uint32_t word() const { return w; }
    void set(float number) { w = std::bit_cast<std::uint32_t>(number); }
    void set(std::uint32_t word) { w = word; }
};
template <class R>
requires has_sets<R>
struct Cell<R> {
    using Terms = std::vector<Interval>;
    typename R::Real x{};
    mutable std::uint32_t w = 0;
    mutable std::uint32_t more = 0; ///< of a word that is open: how many more there are after `w`
    mutable R* chooses = nullptr;   ///< the reading, while the word is open: it is one of these when it is asked for
    bool comes_of_x = false;        ///< an open word is the bits of `x`
    bool is_real = false;           ///< of what was written: which of the two it is
    std::shared_ptr<const Terms> terms; ///< of a sum without `precise`, whose order is open; null: it is none

    [[nodiscard]] const typename R::Real& real() const { return x; }
    [[nodiscard]] bool is_open() const { return chooses != nullptr; }
    [[nodiscard]] bool is_bits_of_x() const { return is_open() && comes_of_x; }
    [[nodiscard]] WordRange range() const { return {w, more}; }
    /// Of an open word one of them, each in a run of its own.
    [[nodiscard]] std::uint32_t word() const {
        if (chooses != nullptr)
            w += std::exchange(chooses, nullptr)->one_of(std::exchange(more, 0));
        return w;
    }
    void set(const typename R::Real& number) {
        set(w);
        x = number;
    }
    void set(std::uint32_t word) {
        w = word;
        more = 0;
        chooses = nullptr;
        comes_of_x = false;
        terms.reset();
    }
    void set(const WordRange& words, R& reading) {
        set(words.first);
        more = words.more;
        if (more > 0)
            chooses = &reading;
    }
    /// The word stays open where the numbers are many, and of one sign.
    void set_bits_of(const typename R::Real& number, R& reading) {
        const Interval all = number.set();
        if (const std::optional<WordRange> words = all.is_point() ? std::nullopt : word_range::bits(all)) {
            set(*words, reading);
            x = number;
            comes_of_x = true;
        } else {
            set(std::bit_cast<std::uint32_t>(reading.one_of(number)));
            x = number;
        }
    }
};

template <class R> using WrittenWords = std::map<WrittenPlace, Cell<R>>;

/// What an invocation of a group may find where others of it write.
struct GroupWord {
    WordRange words = {};                  ///< of an integer; of one float its bits
    std::optional<Interval> set = {};      ///< of a float; nothing: an integer, or one word of either
    Undefined undefined = Undefined::none; ///< then anything
    [[nodiscard]] bool is_one_word() const {
        return undefined == Undefined::none && (set ? set->is_point() : words.more == 0);
    }
};

} // namespace lockstep::text
