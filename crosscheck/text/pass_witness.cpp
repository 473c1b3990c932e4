#include "crosscheck/text/pass_witness.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "crosscheck/text/bound_stage.hpp"
#include "crosscheck/text/group_witness.hpp"

namespace lockstep {
namespace {

/// A block or an image has one number in the runs of both texts.
class CommonNumbers {
  public:
    std::uint32_t of(const std::string& name) {
        return numbers_.emplace(name, static_cast<std::uint32_t>(numbers_.size())).first->second;
    }

  private:
    std::map<std::string, std::uint32_t> numbers_;
};

/// A text's dispatch from one input.
class WitnessedPass {
  public:
    WitnessedPass(const PassText& text, const PassInput& in, const Profile& profile, CommonNumbers& numbers)
        : text_(text), dispatch_(text, in, profile), stage_{text.program(), dispatch_.input().bindings, profile,
                                                            dispatch_.input().groups,
                                                            text.is_per_item() ? &dispatch_.input().stage : nullptr} {
        for (const text::Block& block : text.program().blocks)
            blocks_.push_back(numbers.of(block.name));
        for (const text::ImageUniform& image : text.program().images)
            images_.push_back(numbers.of(image.name));
    }
    WitnessedPass(const WitnessedPass&) = delete;
    WitnessedPass& operator=(const WitnessedPass&) = delete;

    [[nodiscard]] std::optional<std::uint32_t> writer(std::uint8_t resource, std::size_t item) const {
        return dispatch_.writer(resource, item);
    }
    [[nodiscard]] const BoundStage& stage() const { return stage_; }
    [[nodiscard]] const ShaderSource& source() const { return text_.source(); }
    /// Where another text's block or image is in this one.
    [[nodiscard]] std::optional<text::WrittenPlace> place_of(const WitnessedPass& other,
                                                             text::WrittenPlace place) const {
        const std::vector<std::uint32_t>& own = place.is_of_block() ? blocks_ : images_;
        const std::uint32_t number = (place.is_of_block() ? other.blocks_ : other.images_)[place.number];
        const auto found = std::ranges::find(own, number);
        if (found == own.end())
            return {};
        place.number = static_cast<std::uint32_t>(found - own.begin());
        return place;
    }
    [[nodiscard]] WitnessedText text() const {
        return {text_.program(),
                [this](std::uint32_t invocation, std::span<const text::ForcedRow> forced) {
                    return stage_.traced(invocation, forced);
                },
                [this](const text::WrittenPlace& place) { return common(place); }, text_.source()};
    }

  private:
    /// Outputs that are not captured are no places.
    [[nodiscard]] std::optional<text::WrittenPlace> common(text::WrittenPlace place) const {
        using Space = text::WrittenPlace::Space;
        if (place.space == Space::output) {
            const std::optional<std::size_t> component = text_.captured_component(place.word);
            if (!component)
                return {};
            place.word = *component;
        } else if (place.space == Space::shared) {
            return {};
        } else {
            place.number = place.is_of_block() ? blocks_[place.number] : images_[place.number];
        }
        return place;
    }

    const PassText& text_;
    TextDispatch dispatch_;
    BoundStage stage_;
    std::vector<std::uint32_t> blocks_, images_;
};

} // namespace

std::vector<WitnessLine> witness_lines(const PassText& wrong, const PassText& reference, const PassInput& in,
                                       const Profile& profile, std::uint8_t resource,
                                       std::span<const std::size_t> items, std::span<const std::size_t> others,
                                       const std::function<bool(std::string_view where)>& is_own) {
    CommonNumbers numbers;
    const WitnessedPass of_wrong(wrong, in, profile, numbers), of_reference(reference, in, profile, numbers);
    const auto writers = [&](std::span<const std::size_t> all) {
        std::vector<ItemWriters> by;
        for (const std::size_t item : all)
            by.push_back({of_wrong.writer(resource, item), of_reference.writer(resource, item)});
        return by;
    };
    const std::vector<ItemWriters> wrong_items = writers(items);
    if (!shares(wrong.program()) && !shares(reference.program()))
        return witness_lines(of_wrong.text(), of_reference.text(), wrong_items, writers(others), is_own);
    return group_witness_lines(
        {of_wrong.stage(), of_wrong.source()}, {of_reference.stage(), of_reference.source()}, wrong_items,
        writers(others), [&](const text::WrittenPlace& place) { return of_wrong.place_of(of_reference, place); },
        is_own);
}

} // namespace lockstep
