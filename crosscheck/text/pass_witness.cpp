#include "crosscheck/text/pass_witness.hpp"

#include <map>
#include <optional>
#include <string>

#include "crosscheck/text/bound_stage.hpp"

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
                                                            text.is_vertex() ? &dispatch_.input().vertices : nullptr} {
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
    [[nodiscard]] WitnessedText text() const {
        return {text_.program(),
                [this](std::uint32_t invocation, std::span<const text::ForcedRow> forced) {
                    return stage_.traced(invocation, forced);
                },
                [this](const text::WrittenPlace& place) { return common(place); },
                [this](std::uint32_t line) { return text_.line_text(line); }};
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
    return witness_lines(of_wrong.text(), of_reference.text(), writers(items), writers(others), is_own);
}

} // namespace lockstep
