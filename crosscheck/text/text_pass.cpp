#include "crosscheck/text/text_pass.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/parallel_blocks.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"
#include "reference/system/pass_by_driver.hpp"
#include "reference/text/outcomes.hpp"

namespace lockstep {
namespace {

using Space = text::WrittenPlace::Space;

PassStage stage_of(const GlPass& pass) {
    return pass.stage == Stage::compute    ? PassStage::compute
           : pass.stage == Stage::fragment ? PassStage::fragment
                                           : PassStage::vertex;
}

/// Which of an item's components it is.
std::size_t place_of(const Resource& about, const Component& one) {
    std::size_t place = static_cast<std::size_t>(one.component);
    for (std::uint8_t f = 0; f < one.field; ++f)
        place += static_cast<std::size_t>(about.fields[f].components);
    return place;
}

/// The last dispatch that some pass of it ran: those that continue the pass take what it wrote from here.
struct LastDispatch {
    std::mutex mutex;
    std::shared_ptr<const TextDispatch> dispatch;
};

} // namespace

TextDispatch::TextDispatch(const PassText& text, const PassInput& in, const Profile& profile)
    : text_(text), profile_(profile), frame_(in.frame), input_(text.bind(in, profile)) {
    for (const View& resource : in.before.resources)
        extents_.push_back(resource.extent);
}

void TextDispatch::run() const {
    std::call_once(ran_, [&] {
        written_ = input_.words;
        text::Findings findings;
        text_.run_into(input_, profile_, findings, {}, &writers_, written_);
    });
}

std::vector<std::uint32_t> TextDispatch::words(const View& before, std::uint8_t resource, std::size_t item) const {
    run();
    std::vector<std::uint32_t> all = item_words(before, item);
    for (const std::size_t from : text_.words_of_resource(resource)) {
        const std::span<const Component> record = text_.record(from);
        for (std::size_t k = 0; k < record.size(); ++k)
            if (record[k] != no_component)
                all[place_of(before.about(), record[k])] = written_[from][item * record.size() + k];
    }
    return all;
}

void TextDispatch::write(const View& before, std::uint8_t resource, std::size_t first, std::size_t last,
                         const WritableView& after) const {
    run();
    const std::vector<item_twin::WordColumn> columns = item_twin::word_columns(after);
    const auto put = [&](std::size_t place, std::size_t item, std::uint32_t word) {
        std::memcpy(columns[place].first + item * columns[place].stride, &word, sizeof word);
    };
    std::vector<bool> is_written(columns.size());
    for (const std::size_t from : text_.words_of_resource(resource)) {
        const std::span<const Component> record = text_.record(from);
        for (std::size_t k = 0; k < record.size(); ++k) {
            if (record[k] == no_component)
                continue;
            const std::size_t place = place_of(before.about(), record[k]);
            is_written[place] = true;
            for (std::size_t item = first; item < last; ++item)
                put(place, item, written_[from][item * record.size() + k]);
        }
    }
    const std::vector<Component> parts = components(before.about());
    for (std::size_t place = 0; place < parts.size(); ++place)
        for (std::size_t item = first; item < last && !is_written[place]; ++item)
            put(place, item, before.value(parts[place].field, item, parts[place].component).bits);
}

std::optional<std::uint32_t> TextDispatch::writer(std::uint8_t resource, std::size_t item) const {
    if (text_.is_per_item())
        return invocation_at(resource, item);
    run();
    std::uint32_t writer = 0;
    for (const std::size_t from : text_.words_of_resource(resource)) {
        const bool is_block = from < writers_.blocks.size();
        const std::vector<std::uint32_t>& by =
            is_block ? writers_.blocks[from] : writers_.images[from - writers_.blocks.size()];
        const std::size_t size = text_.record(from).size();
        for (std::size_t k = item * size; k < (item + 1) * size; ++k) {
            if (by[k] != 0 && writer != 0 && by[k] != writer)
                return {};
            writer = std::max(writer, by[k]);
        }
    }
    return writer == 0 ? invocation_at(resource, item) : std::optional(writer - 1);
}

std::optional<std::uint32_t> TextDispatch::invocation_at(std::uint8_t resource, std::size_t item) const {
    const Extent& extent = extents_[resource];
    if (text_.is_per_item())
        return text_.invocation_of(item, extent);
    const std::array<std::size_t, 3> at{item % extent.width, item / extent.width % extent.height,
                                        item / extent.width / extent.height};
    const std::array<std::uint32_t, 3>& size = text_.program().group;
    std::size_t group = 0, local = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
        if (at[axis] / size[axis] >= input_.groups[axis])
            return {};
        group = group * input_.groups[axis] + at[axis] / size[axis];
        local = local * size[axis] + at[axis] % size[axis];
    }
    const auto number = static_cast<std::uint32_t>(group * text_.program().invocations() + local);
    const text::Invocation found = text_.invocation(input_, number);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::size_t{found.group[axis]} * size[axis] + found.local[axis] != at[axis])
            return {};
    return number;
}

std::optional<Component> TextDispatch::component_at(std::uint8_t resource, std::size_t item,
                                                    const text::WrittenPlace& place) const {
    const std::size_t blocks = input_.bindings.blocks.size();
    for (const std::size_t from : text_.words_of_resource(resource)) {
        const std::span<const Component> record = text_.record(from);
        if (text_.is_per_item()) {
            const std::optional<std::size_t> captured =
                place.space == Space::output ? text_.captured_component(place.word) : std::nullopt;
            if (captured && *captured < record.size())
                return record[*captured];
            continue;
        }
        const bool is_block = from < blocks;
        if (place.space != (is_block ? Space::block : Space::texel) ||
            place.number != (is_block ? from : from - blocks))
            continue;
        const std::uint64_t at = place.word - item * record.size(); // far beyond, where it is before
        if (at < record.size() && record[at] != no_component)
            return record[at];
    }
    return {};
}

std::optional<std::vector<std::uint32_t>> TextDispatch::words_by(const View& before, std::uint8_t resource,
                                                                 std::size_t item,
                                                                 std::span<const text::TracedWord> written) const {
    std::vector<std::uint32_t> all = item_words(before, item);
    bool is_written = false;
    for (const text::TracedWord& word : written)
        if (const std::optional<Component> c = component_at(resource, item, word.place)) {
            if (word.place.space == Space::texel &&
                input_.bindings.images[word.place.number].code != text::TexelMemory::Code::number)
                return {};
            all[place_of(before.about(), *c)] = word.bits;
            is_written = true;
        }
    return is_written ? std::optional(std::move(all)) : std::nullopt;
}

const text::DispatchOutcomes& TextDispatch::outcomes_by(const KnownOperations& known, text::Constants constants) const {
    const std::scoped_lock lock(outcomes_mutex_);
    for (const auto& one : outcomes_)
        if (one->dispatch().known == known && one->dispatch().constants == constants)
            return *one;
    return *outcomes_.emplace_back(std::make_unique<text::DispatchOutcomes>(
        text_.outcomes(), input_.bindings,
        text::JudgedDispatch{input_.groups, stage_of(text_.pass()), profile_, known, constants}));
}

std::vector<ItemOutcome> TextDispatch::outcomes(const View& before, std::uint8_t resource, std::size_t item,
                                                const KnownOperations& known, text::Constants constants) const {
    run();
    const std::optional<std::uint32_t> by = writer(resource, item);
    if (!by)
        return {};
    const Resource& about = before.about();
    const std::vector<Component> parts = components(about);
    std::vector<ItemOutcome> all;
    try {
        for (text::InvocationOutcome& one :
             outcomes_by(text_.is_per_item() ? known : in_compute_stage(known, profile_), constants)
                 .of(text_.invocation(input_, *by), text_.inputs_of(input_, *by))) {
            ItemOutcome outcome{.values = {}, .open = std::move(one.open), .undefined = one.undefined};
            for (const Component& c : parts)
                outcome.values.push_back(one.undefined != Undefined::none
                                             ? Interval::anything()
                                             : item_twin::set_of(before.value(c.field, item, c.component).bits,
                                                                 about.fields[c.field].scalar));
            for (const text::WrittenWord& word : one.written)
                if (const std::optional<Component> c = component_at(resource, item, word.place)) {
                    outcome.values[place_of(about, *c)] =
                        word.is_code ? word.set : word.set_in(about.fields[c->field].scalar);
                }
            all.push_back(std::move(outcome));
        }
    } catch (const Error&) {
        return {}; // what is not followed by sets
    }
    return all;
}

namespace {

class TextPass final : public PassByProfile {
  public:
    TextPass(std::shared_ptr<const ItemPass> twin, std::shared_ptr<const PassText> text,
             std::shared_ptr<LastDispatch> last, std::shared_ptr<const TextDispatch> one)
        : twin_(std::move(twin)), text_(std::move(text)), last_(std::move(last)), one_(std::move(one)) {}

    [[nodiscard]] bool in_place(const PassInput& /*in*/) const override { return false; }
    [[nodiscard]] std::span<const std::uint8_t> keeps() const override { return twin_->keeps(); }
    void run(const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
             const WritableView& after) const override {
        dispatched(in, profile)->write(in.before[resource()], resource(), first, last, after);
    }
    bool run_all(const PassInput& in, const Profile& profile, const WritableView& after) const override {
        const std::shared_ptr<const TextDispatch> dispatch = dispatched(in, profile);
        parallel_ranges(after.count(), [&](std::size_t first, std::size_t last) {
            dispatch->write(in.before[resource()], resource(), first, last, after);
        });
        return true;
    }
    [[nodiscard]] std::unique_ptr<ItemPass> prepared(const PassInput& in, const Profile& profile) const override {
        return std::make_unique<TextPass>(twin_, text_, last_, dispatched(in, profile));
    }
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& profile,
                                                    const KnownOperations& known,
                                                    const View* /*observed*/) const override {
        const std::shared_ptr<const TextDispatch> dispatch = dispatched(in, profile);
        std::vector<ItemOutcome> all = dispatch->outcomes(in.before[resource()], resource(), item, known);
        if (!all.empty())
            return all;
        const std::vector<std::uint32_t> words = dispatch->words(in.before[resource()], resource(), item);
        const Resource& about = in.before[resource()].about();
        ItemOutcome one;
        for (const Component& c : components(about))
            one.values.push_back(item_twin::set_of(words[one.values.size()], about.fields[c.field].scalar));
        return {std::move(one)};
    }
    [[nodiscard]] std::vector<RecordedRow> record(const PassInput& /*in*/, std::size_t /*item*/,
                                                  const Profile& /*profile*/) const override {
        return {};
    }
    [[nodiscard]] FollowedStep follow(const PassInput& /*in*/, std::size_t /*item*/, const Profile& /*profile*/,
                                      const KnownOperations& /*known*/,
                                      std::span<const ToldValue> /*told*/) const override {
        return {};
    }
    [[nodiscard]] std::vector<SeenSite> sites(const PassInput& /*in*/, std::size_t /*item*/,
                                              const Profile& /*profile*/) const override {
        return {};
    }
    [[nodiscard]] std::vector<std::uint32_t> mistaken(const PassInput& in, std::size_t item, const Profile& profile,
                                                      std::span<const Mistake> /*made*/) const override {
        return dispatched(in, profile)->words(in.before[resource()], resource(), item);
    }

  private:
    [[nodiscard]] const ItemPass& on(const Profile& /*profile*/) const override { return *twin_; }
    [[nodiscard]] const ItemPass& any() const override { return *twin_; }

    std::shared_ptr<const TextDispatch> dispatched(const PassInput& in, const Profile& profile) const {
        if (one_)
            return one_;
        const std::scoped_lock lock(last_->mutex);
        if (!continues())
            last_->dispatch = std::make_shared<const TextDispatch>(*text_, in, profile);
        else if (last_->dispatch == nullptr || last_->dispatch->frame() != in.frame)
            throw Error(fmt::format("{}: the pass that it continues has not run in frame {}", name(), in.frame));
        return last_->dispatch;
    }

    std::shared_ptr<const ItemPass> twin_;
    std::shared_ptr<const PassText> text_;
    std::shared_ptr<LastDispatch> last_;
    std::shared_ptr<const TextDispatch> one_; ///< of one input
};

} // namespace

void take_text(std::span<std::unique_ptr<ItemPass>> passes, const std::shared_ptr<const PassText>& text) {
    const auto last = std::make_shared<LastDispatch>();
    for (std::unique_ptr<ItemPass>& pass : passes)
        pass = std::make_unique<TextPass>(std::move(pass), text, last, nullptr);
}

namespace {

/// Leaves an item as it was.
struct Unchanged {
    std::uint8_t resource;

    template <class R> ItemWords<R> operator()(R& /*r*/, const PassInput& in, std::size_t item) const {
        ItemWords<R> words;
        for (const std::uint32_t word : item_words(in.before[resource], item))
            if (words.size() < ItemWords<R>::most)
                words.add(word);
        return words;
    }
};

} // namespace

std::vector<std::unique_ptr<ItemPass>> passes_without_twins(std::span<const GlPass> passes) {
    std::vector<std::unique_ptr<ItemPass>> made;
    for (const GlPass& pass : passes)
        made.push_back(item_pass({.name = pass.name,
                                  .resource = pass.resource,
                                  .stage = stage_of(pass),
                                  .runs = pass.runs,
                                  .continues = pass.continues},
                                 Unchanged{pass.resource}));
    return made;
}

namespace {

class OwnTextOfPass final : public OwnText {
  public:
    OwnTextOfPass(std::shared_ptr<const PassText> text, std::uint8_t resource,
                  std::shared_ptr<const TextDispatch> dispatch)
        : text_(std::move(text)), resource_(resource), dispatch_(std::move(dispatch)) {}
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& profile,
                                                    const KnownOperations& known) const override {
        return outcomes(in, item, profile, known, text::Constants::rounded);
    }
    [[nodiscard]] std::vector<ItemOutcome> outcomes_as_written(const PassInput& in, std::size_t item,
                                                               const Profile& profile,
                                                               const KnownOperations& known) const override {
        return outcomes(in, item, profile, known, text::Constants::as_written);
    }
    [[nodiscard]] std::shared_ptr<const OwnText> prepared(const PassInput& in, const Profile& profile) const override {
        return std::make_shared<OwnTextOfPass>(text_, resource_,
                                               std::make_shared<const TextDispatch>(*text_, in, profile));
    }

  private:
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& profile,
                                                    const KnownOperations& known, text::Constants constants) const {
        const auto of = [&](const TextDispatch& dispatch) {
            return dispatch.outcomes(in.before[resource_], resource_, item, known, constants);
        };
        return dispatch_ ? of(*dispatch_) : of(TextDispatch(*text_, in, profile));
    }

    std::shared_ptr<const PassText> text_;
    std::uint8_t resource_;
    std::shared_ptr<const TextDispatch> dispatch_; ///< of one input
};

} // namespace

std::shared_ptr<const OwnText> own_text(std::shared_ptr<const PassText> text, std::uint8_t resource) {
    return std::make_shared<OwnTextOfPass>(std::move(text), resource, nullptr);
}

} // namespace lockstep
