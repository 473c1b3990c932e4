#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "reference/text/findings.hpp"
#include "reference/text/invocation.hpp"
#include "reference/text/program.hpp"
#include "reference/text/races.hpp"

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

/// Whether a texel is in the image.
[[nodiscard]] bool is_inside(const TexelMemory& image, const std::array<std::int32_t, 3>& at);
/// Where its components begin in the image's words.
[[nodiscard]] std::size_t first_word(const TexelMemory& image, const std::array<std::int32_t, 3>& at);

/// Who wrote last, of each word of blocks and of each word of images; 0: nobody, else the invocation's number and 1.
struct Writers {
    std::vector<std::vector<std::uint32_t>> blocks = {}, images = {};
    /// Each word that is written, shared ones and those that atomic operations change too, by whom; null: nobody asks.
    std::vector<std::pair<WrittenPlace, std::uint32_t>>* writes = nullptr;
};

/// What lies outside of invocations, by number in the program.
struct Bindings {
    std::vector<std::span<std::uint32_t>> blocks;
    std::vector<TexelMemory> images;
    std::vector<std::vector<std::uint32_t>> uniforms; ///< words of each; fewer than it has are followed by zeros
};

/// The memory of a dispatch: blocks and images, and the shared variables of the group that runs. What lies outside of
/// it reads as 0 and is not written (GL 4.6, 6.4, with robust access), and is a finding.
class Memory {
  public:
    /// `races`: is shown all that is touched; null: nobody looks. `writers`: likewise.
    Memory(const Program& program, const Bindings& bindings, Findings& findings, Races* races,
           Writers* writers = nullptr);

    void start_group(std::uint32_t number) {
        std::fill(shared_.begin(), shared_.end(), 0U);
        std::fill(unset_.begin(), unset_.end(), std::uint8_t{1});
        for (const NamedCells& one : program_.set_shared)
            if (!unset_.empty())
                std::fill_n(unset_.begin() + one.first, one.count, std::uint8_t{0});
        if (races_ != nullptr)
            races_->start_group(number);
    }
    /// Whether no invocation of the group has written a shared word. Known where races are looked for.
    [[nodiscard]] bool is_unset(std::uint32_t word) const { return word < unset_.size() && unset_[word] != 0; }
    [[nodiscard]] Findings& findings() { return findings_; }
    [[nodiscard]] Races* races() { return races_; }
    [[nodiscard]] bool notes_writers() const { return writers_ != nullptr; }
    /// How many words have changed, and how many were read that others may write, the last of them where; counted
    /// where races are looked for.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }
    [[nodiscard]] std::uint64_t reads() const { return reads_; }
    [[nodiscard]] Place last_read() const { return last_read_; }

    /// A block's words, for who looks at what it touches by itself.
    [[nodiscard]] std::span<std::uint32_t> words(std::uint32_t block) const { return bindings_.blocks[block]; }
    [[nodiscard]] std::uint32_t load_block(std::uint32_t block, std::uint32_t word, Place by) {
        const std::span<const std::uint32_t> words = bindings_.blocks[block];
        touch_block(block, word, Races::How::read, by);
        return word < words.size() ? words[word] : outside_block(block, word, by);
    }
    void store_block(std::uint32_t block, std::uint32_t word, std::uint32_t value, Place by) {
        const std::span<std::uint32_t> words = bindings_.blocks[block];
        touch_block(block, word, Races::How::write, by);
        if (word >= words.size()) {
            outside_block(block, word, by);
            return;
        }
        put(words[word], value);
        note_write({WrittenPlace::Space::block, block, word}, by);
        if (writers_ != nullptr)
            writers_->blocks[buffer_of_[block]][word] = by.invocation + 1;
    }
    [[nodiscard]] std::uint32_t load_shared(std::uint32_t word, Place by) {
        touch_shared(word, Races::How::read, by);
        return word < shared_.size() ? shared_[word] : outside_shared(by);
    }
    void store_shared(std::uint32_t word, std::uint32_t value, Place by) {
        touch_shared(word, Races::How::write, by);
        note_write({WrittenPlace::Space::shared, 0, word}, by);
        if (word < shared_.size())
            put(shared_[word], value);
        else
            outside_shared(by);
    }
    /// An index of a vector or array that has `count` elements.
    void note_index(std::uint32_t index, std::uint32_t count, Place by);
    /// Elements of the array without a length at the block's end.
    [[nodiscard]] std::uint32_t length(std::uint32_t block) const;

    using Texel = std::array<std::uint32_t, 4>;
    /// The texel as the shader reads it: bits of floats, or integers. Beyond the image all are 0 (GL 4.6, 8.26);
    /// `fetched`: the level that texelFetch names, which gives that no value. There is level 0 alone.
    [[nodiscard]] Texel load_texel(std::uint32_t image, const std::array<std::int32_t, 3>& at,
                                   std::optional<std::int32_t> fetched, Place by);
    void store_texel(std::uint32_t image, const std::array<std::int32_t, 3>& at, const Texel& texel, Place by);
    /// What texture() makes of a place, 0 to 1 along each axis: GL_LINEAR as drivers with weights of all bits do it,
    /// fma(f, b - a, a) along x, then y, then z (GL 4.6, 8.14.3). The last of an arrayed image's axes is its layer.
    /// `moved`: by how many texels (GLSL 4.60, 8.9.3).
    [[nodiscard]] Texel sample(std::uint32_t image, std::array<float, 3> place, std::uint32_t axes,
                               const std::array<std::int32_t, 3>& moved);
    /// A texel as a sampler finds it at or beyond the image's edges.
    [[nodiscard]] Texel texel_at_edge(std::uint32_t image, std::array<std::int32_t, 3> at) const;
    [[nodiscard]] const TexelMemory& image(std::uint32_t number) const { return bindings_.images[number]; }

    /// `change(before)` takes the place of a word; returns the word before.
    template <class Change>
    std::uint32_t atomic_block(std::uint32_t block, std::uint32_t word, Place by, const Change& change) {
        const std::span<std::uint32_t> words = bindings_.blocks[block];
        touch_block(block, word, Races::How::atomic, by);
        if (word >= words.size())
            return outside_block(block, word, by);
        note_write({WrittenPlace::Space::block, block, word}, by);
        return put(words[word], change(words[word]));
    }
    template <class Change> std::uint32_t atomic_shared(std::uint32_t word, Place by, const Change& change) {
        touch_shared(word, Races::How::atomic, by);
        if (word >= shared_.size())
            return outside_shared(by);
        note_write({WrittenPlace::Space::shared, 0, word}, by);
        return put(shared_[word], change(shared_[word]));
    }
    template <class Change> std::uint32_t atomic_texel(std::uint32_t image, const std::array<std::int32_t, 3>& at,
                                                       Place by, const Change& change) {
        Texel texel = texel_words(image, at);
        const std::uint32_t before = texel[0];
        texel[0] = change(before);
        put_texel(image, at, texel);
        if (is_inside(bindings_.images[image], at))
            note_write({WrittenPlace::Space::texel, image, first_word(bindings_.images[image], at)}, by);
        touch_texel(image, at, Races::How::atomic, by);
        return before;
    }

  private:
    void note_write(const WrittenPlace& place, Place by) {
        if (writers_ != nullptr && writers_->writes != nullptr)
            writers_->writes->emplace_back(place, by.invocation);
    }
    /// Returns what was there before.
    std::uint32_t put(std::uint32_t& word, std::uint32_t value) {
        changes_ += word != value ? 1 : 0;
        return std::exchange(word, value);
    }
    void note_read(Races::How how, Place by) {
        if (how == Races::How::write)
            return;
        ++reads_;
        last_read_ = by;
    }
    void touch_block(std::uint32_t block, std::uint32_t word, Races::How how, Place by) {
        if (races_ == nullptr || !program_.blocks[block].is_storage || word >= bindings_.blocks[block].size() ||
            is_elsewhere(by))
            return;
        note_read(how, by);
        races_->touch(Races::Space::buffer, buffer_of_[block], word, how, by, program_.blocks[block].name,
                      program_.blocks[block].is_coherent(word));
    }
    void touch_shared(std::uint32_t word, Races::How how, Place by) {
        if (races_ == nullptr || word >= unset_.size() || is_elsewhere(by))
            return;
        note_read(how, by);
        races_->touch(Races::Space::shared, 0, word, how, by, program_.shared_at(word));
        if (how != Races::How::read)
            unset_[word] = 0;
    }
    /// The invocation's line has an index out of bounds: what it touches is not what it says.
    [[nodiscard]] bool is_elsewhere(Place by) const {
        return !outside_.empty() && outside_.contains(std::uint64_t{by.line} << 32U | by.invocation);
    }
    void touch_texel(std::uint32_t image, const std::array<std::int32_t, 3>& at, Races::How how, Place by);
    [[nodiscard]] Texel texel_words(std::uint32_t image, const std::array<std::int32_t, 3>& at) const;
    void put_texel(std::uint32_t image, const std::array<std::int32_t, 3>& at, const Texel& texel);
    std::uint32_t outside_block(std::uint32_t block, std::uint32_t word, Place by);
    std::uint32_t outside_shared(Place by);

    const Program& program_;
    const Bindings& bindings_;
    Findings& findings_;
    Races* races_;
    Writers* writers_;
    std::vector<std::uint32_t> shared_;
    std::vector<std::uint8_t> unset_;                 ///< of shared words
    std::unordered_set<std::uint64_t> outside_;       ///< lines and invocations of indexes out of bounds
    std::vector<std::uint32_t> buffer_of_, image_of_; ///< of each block and image: the first of the same words
    std::uint64_t changes_ = 0, reads_ = 0;
    Place last_read_;
};

} // namespace lockstep::text
