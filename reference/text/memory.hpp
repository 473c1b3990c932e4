#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reference/text/findings.hpp"
#include "reference/text/program.hpp"

namespace lockstep::text {

/// An image as the shader sees it: words, as many a texel as it has components.
struct TexelMemory {
    /// What a component's word is.
    enum class Code : std::uint8_t {
        number, ///< the bits of a float or an integer, as the shader has it
        half,   ///< the bits of a float that is a half
        unorm8  ///< 0 to 255, of 0.0 to 1.0
    };
    /// How texture() reads it, level 0 alone.
    enum class Filter : std::uint8_t { nearest, linear, linear_in_black }; ///< at the edges clamped, or 0 beyond them
    std::string name = {};
    std::array<std::uint32_t, 3> size{1, 1, 1};
    std::uint32_t components = 4;
    Code code = Code::number;
    Filter filter = Filter::nearest;
    std::span<std::uint32_t> words = {};
};

/// What lies outside of invocations, by number in the program.
struct Bindings {
    std::vector<std::span<std::uint32_t>> blocks;
    std::vector<TexelMemory> images;
    std::vector<std::vector<std::uint32_t>> uniforms; ///< words of each; fewer than it has are followed by zeros
};

/// Who touches memory, for findings.
struct Toucher {
    std::uint32_t line = 0, invocation = 0;
};

/// The memory of a dispatch: blocks and images, and the shared variables of the group that runs. What lies outside of
/// it reads as 0 and is not written (GL 4.6, 6.4, with robust access), and is a finding.
class Memory {
  public:
    Memory(const Program& program, const Bindings& bindings, Findings& findings)
        : program_(program), bindings_(bindings), findings_(findings), shared_(program.shared) {}

    void start_group() { std::fill(shared_.begin(), shared_.end(), 0U); }

    [[nodiscard]] std::uint32_t load_block(std::uint32_t block, std::uint32_t word, Toucher by) {
        const std::span<const std::uint32_t> words = bindings_.blocks[block];
        return word < words.size() ? words[word] : outside_block(block, word, by);
    }
    void store_block(std::uint32_t block, std::uint32_t word, std::uint32_t value, Toucher by) {
        const std::span<std::uint32_t> words = bindings_.blocks[block];
        if (word < words.size())
            words[word] = value;
        else
            outside_block(block, word, by);
    }
    [[nodiscard]] std::uint32_t load_shared(std::uint32_t word, Toucher by) {
        return word < shared_.size() ? shared_[word] : outside_shared(by);
    }
    void store_shared(std::uint32_t word, std::uint32_t value, Toucher by) {
        if (word < shared_.size())
            shared_[word] = value;
        else
            outside_shared(by);
    }
    /// An index of a vector or array that has `count` elements.
    void note_index(std::uint32_t index, std::uint32_t count, Toucher by);
    /// Elements of the array without a length at the block's end.
    [[nodiscard]] std::uint32_t length(std::uint32_t block) const;

    using Texel = std::array<std::uint32_t, 4>;
    /// The texel as the shader reads it: bits of floats, or integers. Beyond the image all are 0 (GL 4.6, 8.26);
    /// `is_fetch`: texelFetch gives that no value.
    [[nodiscard]] Texel load_texel(std::uint32_t image, const std::array<std::int32_t, 3>& at, bool is_fetch,
                                   Toucher by);
    void store_texel(std::uint32_t image, const std::array<std::int32_t, 3>& at, const Texel& texel, Toucher by);
    /// What texture() makes of a place, 0 to 1 along each axis: GL_LINEAR as drivers with weights of all bits do it,
    /// fma(f, b - a, a) along x, then y, then z (GL 4.6, 8.14.3).
    [[nodiscard]] Texel sample(std::uint32_t image, const std::array<float, 3>& place, std::uint32_t axes);
    [[nodiscard]] const TexelMemory& image(std::uint32_t number) const { return bindings_.images[number]; }

    /// `change(before)` takes the place of a word; returns the word before.
    template <class Change>
    std::uint32_t atomic_block(std::uint32_t block, std::uint32_t word, Toucher by, const Change& change) {
        const std::uint32_t before = load_block(block, word, by);
        if (word < bindings_.blocks[block].size())
            bindings_.blocks[block][word] = change(before);
        return before;
    }
    template <class Change> std::uint32_t atomic_shared(std::uint32_t word, Toucher by, const Change& change) {
        const std::uint32_t before = load_shared(word, by);
        if (word < shared_.size())
            shared_[word] = change(before);
        return before;
    }
    template <class Change> std::uint32_t atomic_texel(std::uint32_t image, const std::array<std::int32_t, 3>& at,
                                                       Toucher by, const Change& change) {
        Texel texel = load_texel(image, at, false, by);
        const std::uint32_t before = texel[0];
        texel[0] = change(before);
        store_texel(image, at, texel, by);
        return before;
    }

  private:
    [[nodiscard]] Texel texel_at_edge(std::uint32_t image, std::array<std::int32_t, 3> at);
    std::uint32_t outside_block(std::uint32_t block, std::uint32_t word, Toucher by);
    std::uint32_t outside_shared(Toucher by);

    const Program& program_;
    const Bindings& bindings_;
    Findings& findings_;
    std::vector<std::uint32_t> shared_;
};

} // namespace lockstep::text
