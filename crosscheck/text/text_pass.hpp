#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "crosscheck/text/pass_text.hpp"
#include "reference/system/own_text.hpp"
#include "reference/text/trace.hpp"

namespace lockstep {

/// One dispatch of a text from one input: what it writes, by whom, and what each invocation may legally write. Runs
/// when it is first asked; any number of threads may ask.
class TextDispatch {
  public:
    /// Copies what the dispatch reads. `text` outlives this.
    TextDispatch(const PassText& text, const PassInput& in, const Profile& profile);

    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] const PassText::Input& input() const { return input_; }
    /// The one invocation that wrote of an item, by its number, or, where none did, that which stands where the item
    /// does: it may have been about to. Nothing: several wrote of it, or none stands there.
    [[nodiscard]] std::optional<std::uint32_t> writer(std::uint8_t resource, std::size_t item) const;
    /// The invocation that stands where the item does; nothing: none.
    [[nodiscard]] std::optional<std::uint32_t> invocation_at(std::uint8_t resource, std::size_t item) const;
    /// An item's words where one invocation alone wrote `written`; nothing: it wrote none of them, or they are stored
    /// otherwise than they were written.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> words_by(const View& before, std::uint8_t resource,
                                                                     std::size_t item,
                                                                     std::span<const text::TracedWord> written) const;
    /// Items first to last of a resource, the last excluded, into `after`; what the text does not write is as `before`
    /// has it, and fields that are left out stay so.
    void write(const View& before, std::uint8_t resource, std::size_t first, std::size_t last,
               const WritableView& after) const;
    /// An item's words, component by component.
    [[nodiscard]] std::vector<std::uint32_t> words(const View& before, std::uint8_t resource, std::size_t item) const;
    /// Every legal outcome of an item. Empty where sets are not followed, or several invocations wrote of it.
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const View& before, std::uint8_t resource, std::size_t item,
                                                    const KnownOperations& known,
                                                    text::Constants constants = text::Constants::rounded) const;

  private:
    void run() const;
    /// Which of an item's components a place is; nothing: none.
    [[nodiscard]] std::optional<Component> component_at(std::uint8_t resource, std::size_t item,
                                                        const text::WrittenPlace& place) const;

    const PassText& text_;
    Profile profile_;
    int frame_;
    PassText::Input input_;       ///< as it was bound
    std::vector<Extent> extents_; ///< of the state before
    mutable std::once_flag ran_;
    mutable std::vector<std::vector<std::uint32_t>> written_; ///< PassText::Input::words behind it
    mutable text::Writers writers_;
    [[nodiscard]] const text::DispatchOutcomes& outcomes_by(const KnownOperations& known,
                                                            text::Constants constants) const;
    mutable std::mutex outcomes_mutex_;
    mutable std::vector<std::unique_ptr<text::DispatchOutcomes>> outcomes_; ///< one for each way that was asked for
};

/// The passes of one dispatch that a text makes, instead of their twins, which say all that is no arithmetic:
/// resources, stage, when they run. Those that continue the first take what its dispatch wrote.
void take_text(std::span<std::unique_ptr<ItemPass>> passes, const std::shared_ptr<const PassText>& text);

/// Passes that leave every item as it was: what they are before a text makes them.
std::vector<std::unique_ptr<ItemPass>> passes_without_twins(std::span<const GlPass> passes);

/// What the GPU's shader says of a pass, by its own text; of one that continues another where the text does not read
/// what that wrote.
std::shared_ptr<const OwnText> own_text(std::shared_ptr<const PassText> text, std::uint8_t resource);

} // namespace lockstep
