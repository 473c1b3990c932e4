#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace lockstep {

/// What a twin returns of items whose fields are known at run time alone: word after word, each a number of the reading
/// R or bits that are copied as they are.
template <class R> class ItemWords {
  public:
    static constexpr std::size_t most = 32;

    void add(const typename R::Real& number) { words_[size_++] = {number, 0, true}; }
    void add(std::uint32_t bits) { words_[size_++] = {{}, bits, false}; }

    [[nodiscard]] std::size_t size() const { return size_; }
    template <class Visit> void for_each(const Visit& visit) const {
        for (std::size_t w = 0; w < size_; ++w)
            if (words_[w].is_number)
                visit(words_[w].number);
            else
                visit(words_[w].bits);
    }

  private:
    struct Word {
        typename R::Real number;
        std::uint32_t bits;
        bool is_number;
    };
    std::array<Word, most> words_{};
    std::size_t size_ = 0;
};

} // namespace lockstep
