#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/model/error.hpp"
#include "reference/parallel_blocks.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/readings/following.hpp"
#include "reference/readings/mistaken.hpp"
#include "reference/readings/mistaken_arithmetic.hpp"
#include "reference/readings/recording.hpp"
#include "reference/readings/values.hpp"
#include "reference/readings/worlds.hpp"
#include "reference/subnormals.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep {

namespace item_twin {

/// Calls `visit` with every number of a struct, in the order of its fields().
template <class State, class Visit> void for_each_number(const State& state, const Visit& visit) {
    if constexpr (requires { state.for_each(visit); })
        state.for_each(visit);
    else if constexpr (requires { state.fields(); })
        std::apply([&](const auto&... part) { (for_each_number(part, visit), ...); }, state.fields());
    else
        visit(state);
}

/// How many numbers a struct has.
template <class State> constexpr std::size_t numbers_in() {
    if constexpr (requires(const State& state) { state.fields(); })
        return []<class... Parts>(std::type_identity<std::tuple<Parts...>>) {
            return (std::size_t{0} + ... + numbers_in<std::remove_cvref_t<Parts>>());
        }(std::type_identity<decltype(std::declval<const State&>().fields())>{});
    else
        return 1;
}

template <class Number> std::uint32_t word_of(const Number& x) {
    if constexpr (std::is_same_v<Number, std::uint32_t>)
        return x;
    else if constexpr (requires { x.word; })
        return x.word;
    else if constexpr (std::is_convertible_v<Number, int> && !std::is_floating_point_v<Number>)
        return static_cast<std::uint32_t>(static_cast<int>(x));
    else
        return std::bit_cast<std::uint32_t>(static_cast<float>(x));
}

template <class Number> Interval set_of(const Number& x) {
    if constexpr (requires { x.legal(); })
        return x.legal();
    else if constexpr (requires { static_cast<double>(x); })
        return {static_cast<double>(x), static_cast<double>(x)};
    else
        return Interval(static_cast<float>(x));
}

/// The same of a number of a field of this type. Bits that a twin copies are the field's, whatever it holds.
template <class Number> Interval set_of(const Number& x, Scalar scalar) {
    if constexpr (std::is_same_v<Number, std::uint32_t>) {
        const Value value{scalar, x};
        if (scalar == Scalar::float32)
            return Interval(value.real());
        const auto integer = static_cast<double>(value.integer());
        return {integer, integer};
    } else {
        return set_of(x);
    }
}

/// A word of which no item of all such words is right: the greatest float, less its last bit.
inline constexpr std::uint32_t nothing_reads_so = 0x7f7ffffe;

/// A twin may have `at(frame)`, which returns the twin of one frame, or `at(in)`, that of one state: what depends on
/// that alone is then made once, not for every item.
template <class Twin> constexpr bool has_at = requires(const Twin& twin, const PassInput& in) { twin.at(in); }
|| requires(const Twin& twin, const PassInput& in) { twin.at(in.frame); };

template <class Twin> decltype(auto) in_frame(const Twin& twin, const PassInput& in) {
    if constexpr (requires { twin.at(in); })
        return twin.at(in);
    else if constexpr (requires { twin.at(in.frame); })
        return twin.at(in.frame);
    else
        return (twin);
}

/// The twin of one input: made here, or that of a pass which was prepared.
template <class Twin> class Framed {
  public:
    Framed(const Twin& twin, const PassInput& in, bool is_prepared) : twin_(&twin) {
        if constexpr (has_at<Twin>)
            if (!is_prepared)
                twin_ = &made_.emplace(in_frame(twin, in));
    }
    Framed(const Framed&) = delete;
    Framed& operator=(const Framed&) = delete;
    const Twin& operator*() const { return *twin_; }

  private:
    std::optional<Twin> made_;
    const Twin* twin_;
};

/// A twin whose products may be fused by mistake says `static constexpr bool may_fuse = true`: that is one more
/// arithmetic to compile.
template <class Twin> constexpr bool may_fuse() {
    if constexpr (requires { Twin::may_fuse; })
        return Twin::may_fuse;
    else
        return false;
}

/// A twin may have `handed(made)`, which returns the twin as a host that makes these mistakes hands it its inputs.
template <class Twin> decltype(auto) as_handed(const Twin& twin, std::span<const Mistake> made) {
    if constexpr (requires { twin.handed(made); })
        return twin.handed(made);
    else
        return (twin);
}

/// Where the words of items lie, one after the other: word w of an item at column w.
struct WordColumn {
    std::byte* first;
    std::size_t stride; ///< bytes from item to item
};

/// Those of a field that is left out are one word, which is never read.
inline std::vector<WordColumn> word_columns(const WritableView& state) {
    static thread_local std::array<std::byte, sizeof(std::uint32_t)> unread;
    std::vector<WordColumn> all;
    for (const Component& c : components(state.about()))
        if (state.columns[c.field] == nullptr)
            all.push_back({unread.data(), 0});
        else
            all.push_back({state.columns[c.field] + static_cast<std::size_t>(c.component) * sizeof(std::uint32_t),
                           static_cast<std::size_t>(state.fields()[c.field].components) * sizeof(std::uint32_t)});
    return all;
}

inline void check_size(std::string_view pass, const Resource& about, std::size_t words) {
    if (words * sizeof(std::uint32_t) != item_bytes(about))
        throw Error(std::string(pass) + ": its twin gives " + std::to_string(words) + " numbers; a " + about.item +
                    " has " + std::to_string(item_bytes(about) / sizeof(std::uint32_t)));
}

} // namespace item_twin

/// Items first to last of a pass, the last excluded, to be made a faster way than one by one. `left` gets those of
/// which none can be made.
struct FastRun {
    const PassInput& in;
    const Profile& profile;
    ArithmeticSwitch arithmetic;
    std::size_t first, last;
    const WritableView& after;
    std::vector<std::size_t>& left;
};

/// For ItemPassOptions::in_place.
inline bool from_any_state(const PassInput& /*in*/) { return true; }

/// What item_pass is told of a pass besides its twin.
struct ItemPassOptions {
    std::string name;          ///< that of its shader
    std::uint8_t resource = 0; ///< the buffer whose items it makes
    PassStage stage = PassStage::vertex;
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain; ///< exact: as shaders/portable.glsl computes
    /// The outputs by which the twin's sites know the fields, in their order; empty: their names.
    std::vector<std::string> outputs = {};
    std::function<bool(int frame)> runs = {};               ///< empty: in every frame
    bool continues = false;                                 ///< ItemPass::continues
    bool derived = false;                                   ///< ItemPass::derived
    bool unordered = false;                                 ///< ItemPass::unordered
    std::function<bool(const PassInput& in)> in_place = {}; ///< ItemPass::in_place; empty: from no state
    /// ItemPass::keeps. check() holds the twin to it in its first run.
    std::vector<std::uint8_t> keeps = {};
    /// ItemPass::appended; empty: each item has its place.
    std::function<ItemRange(const PassInput& in)> appended = {};
    /// A faster way to the twin's bits, held to them by a test: makes those of items first to last, the last excluded,
    /// that it can, and puts the others into `left`. Empty: the twin makes all.
    std::function<void(const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
                       const WritableView& after, std::vector<std::size_t>& left)>
        fast = {};
};

/// A twin as an ItemPass: `twin(r, in, item)`, a template over the reading R& r (values.hpp), pure, returning a struct
/// whose fields() are those of the buffer's items, in order, or ItemWords (item_words.hpp). `twin.at(frame)` or
/// `twin.at(in)`, where there is one, is called in its place (in_frame). `twin.all(values, in, after)`, where there is
/// one, makes all items at once with the same bits, or returns false; `twin.part(values, in, k, after)`, k from 0 to
/// `twin.parts()` - 1, makes them in so many parts, on all threads; `twin.fast(FastRun)` makes some of them, or returns
/// false. A test holds each to the items' bits. `twin.look(in)` is called before all items are made, on one thread.
template <class Twin> class ItemTwin final : public ItemPass {
  public:
    ItemTwin(ItemPassOptions options, Twin twin) : options_(std::move(options)), twin_(std::move(twin)) {
        require_two_roundings();
    }

    [[nodiscard]] std::string_view name() const override { return options_.name; }
    [[nodiscard]] std::uint8_t resource() const override { return options_.resource; }
    [[nodiscard]] PassStage stage() const override { return options_.stage; }
    [[nodiscard]] bool runs(int frame) const override { return !options_.runs || options_.runs(frame); }
    [[nodiscard]] bool continues() const override { return options_.continues; }
    [[nodiscard]] bool derived() const override { return options_.derived; }
    [[nodiscard]] bool in_place(const PassInput& in) const override {
        return options_.in_place && options_.in_place(in);
    }
    [[nodiscard]] std::span<const std::uint8_t> keeps() const override { return options_.keeps; }
    [[nodiscard]] bool unordered() const override { return options_.unordered; }
    [[nodiscard]] std::optional<ItemRange> appended(const PassInput& in) const override {
        return options_.appended ? std::optional(options_.appended(in)) : std::nullopt;
    }

    [[nodiscard]] std::string_view output(const Resource& about, std::uint8_t field) const override {
        return field < options_.outputs.size() ? options_.outputs[field] : about.fields[field].name;
    }

    void run(const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
             const WritableView& after) const override {
        const item_twin::Framed<Twin> framed(twin_, in, is_prepared_);
        run_made(*framed, in, profile, first, last, after);
    }

    bool run_all(const PassInput& in, const Profile& profile, const WritableView& after) const override {
        const item_twin::Framed<Twin> framed(twin_, in, is_prepared_);
        const Twin& twin = *framed;
        return with_arithmetic_of(profile, [&]<class A>(A fp) {
            Values<A> values(fp);
            if constexpr (requires { twin.part(values, in, std::size_t{0}, after); }) {
                parallel_blocks(static_cast<std::ptrdiff_t>(twin.parts()), [&](std::ptrdiff_t part) {
                    const FlushSubnormals guard = flush(profile);
                    Values<A> own(fp);
                    twin.part(own, in, static_cast<std::size_t>(part), after);
                });
                return true;
            } else if constexpr (requires { twin.all(values, in, after); }) {
                const FlushSubnormals guard = flush(profile);
                return twin.all(values, in, after);
            } else if constexpr (item_twin::has_at<Twin>) {
                if constexpr (requires { twin.look(in); }) {
                    const FlushSubnormals guard = flush(profile);
                    twin.look(in);
                }
                parallel_ranges(after.count(), [&](std::size_t first, std::size_t last) {
                    run_made(twin, in, profile, first, last, after);
                });
                return true;
            } else {
                return false;
            }
        });
    }

    [[nodiscard]] std::unique_ptr<ItemPass> prepared(const PassInput& in, const Profile& /*profile*/) const override {
        if constexpr (item_twin::has_at<Twin>) {
            auto one = std::make_unique<ItemTwin>(options_, item_twin::in_frame(twin_, in));
            one->is_prepared_ = true;
            return one;
        } else {
            return nullptr;
        }
    }

    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& profile,
                                                    const KnownOperations& known, const View* observed) const override {
        const FlushSubnormals guard = flush(profile, known.subnormals);
        std::vector<ItemOutcome> found;
        const std::vector<Component> parts = components(about(in));
        const auto& fields = about(in).fields;
        const item_twin::Framed<Twin> framed(twin_, in, is_prepared_);
        const Twin& twin = *framed;
        with_arithmetic_of(profile, [&]<class A>(A fp) {
            Worlds<A> worlds(fp, of_stage(known, profile), profile.other_orders);
            tell_of_driver(worlds, profile);
            std::vector<std::vector<float>> kept;
            if (observed != nullptr)
                tell(worlds, *observed, item, kept);
            worlds.run([&] { return twin(worlds, in, item); },
                       [&](const auto* state, std::span<const Fork> forks, Undefined undefined) {
                           ItemOutcome outcome{.values = {}, .open = open_sites(forks), .undefined = undefined};
                           if (state != nullptr)
                               item_twin::for_each_number(*state, [&](const auto& x) {
                                   const Component& part = parts[outcome.values.size()];
                                   outcome.values.push_back(item_twin::set_of(x, fields[part.field].scalar));
                               });
                           else
                               outcome.values.assign(parts.size(), Interval::anything());
                           add(found, std::move(outcome));
                       });
        });
        return found;
    }

    [[nodiscard]] std::vector<RecordedRow> record(const PassInput& in, std::size_t item,
                                                  const Profile& profile) const override {
        const FlushSubnormals guard = flush(profile);
        const item_twin::Framed<Twin> framed(twin_, in, is_prepared_);
        const Twin& twin = *framed;
        return with_arithmetic_of(profile, [&]<class A>(A fp) {
            Recording<A> reading(fp);
            twin(reading, in, item);
            return reading.rows();
        });
    }

    [[nodiscard]] FollowedStep follow(const PassInput& in, std::size_t item, const Profile& profile,
                                      const KnownOperations& known, std::span<const ToldValue> told) const override {
        const FlushSubnormals guard = flush(profile, known.subnormals);
        const item_twin::Framed<Twin> framed(twin_, in, is_prepared_);
        const Twin& twin = *framed;
        return with_arithmetic_of(profile, [&]<class A>(A fp) {
            Following<A> reading(fp, of_stage(known, profile), profile.other_orders);
            tell_of_driver(reading, profile);
            std::map<std::string_view, int> occurrences;
            for (const ToldValue& value : told)
                if (value.turn < 0)
                    reading.tell_in_order(name_id(value.output), occurrences[value.output]++, value.values);
                else
                    reading.tell_in_turn(name_id(value.output), value.turn, value.values);
            FollowedStep best;
            std::size_t fewest = SIZE_MAX;
            reading.run(
                [&] {
                    reading.start_run();
                    return twin(reading, in, item);
                },
                [&](const auto* /*state*/, std::span<const Fork> forks, Undefined undefined) {
                    const auto wrong =
                        static_cast<std::size_t>(std::count_if(reading.rows().begin(), reading.rows().end(),
                                                               [](const ReadingRow& row) { return !row.is_legal(); }));
                    if (wrong >= fewest)
                        return;
                    fewest = wrong;
                    best = {reading.rows(), open_sites(forks), undefined};
                });
            return best;
        });
    }

    [[nodiscard]] std::vector<SeenSite> sites(const PassInput& in, std::size_t item,
                                              const Profile& profile) const override {
        const FlushSubnormals guard = flush(profile);
        const item_twin::Framed<Twin> framed(twin_, in, is_prepared_);
        const Twin& twin = *framed;
        return with_arithmetic_of(profile, [&]<class A>(A fp) {
            Mistaken<A> reading(fp, {});
            reading.look_at_sites();
            twin(reading, in, item);
            return std::vector<SeenSite>(reading.sites().begin(), reading.sites().end());
        });
    }

    [[nodiscard]] std::vector<std::uint32_t> mistaken(const PassInput& in, std::size_t item, const Profile& profile,
                                                      std::span<const Mistake> made) const override {
        if (is_among(Change::item_kept, made))
            return item_words(in.before[options_.resource], item);
        const FlushSubnormals guard = flush(profile, !is_among(Change::subnormals_kept, made));
        const item_twin::Framed<Twin> framed(twin_, in, is_prepared_);
        const auto& twin = item_twin::as_handed(*framed, made);
        constexpr bool may_fuse = item_twin::may_fuse<Twin>();
        return with_mistaken_arithmetic<may_fuse>(profile, options_.arithmetic, made, [&]<class A>(A fp) {
            try {
                Mistaken<A> reading(fp, made);
                reading.is_of_item(item);
                return words_of(twin(reading, in, item), about(in));
            } catch (const OutsideState&) { // a mistaken index: what a shader reads there is open
                return std::vector<std::uint32_t>(components(about(in)).size(), item_twin::nothing_reads_so);
            }
        });
    }

  private:
    [[nodiscard]] const Resource& about(const PassInput& in) const { return in.before[options_.resource].about(); }

    [[nodiscard]] KnownOperations of_stage(const KnownOperations& known, const Profile& profile) const {
        if (options_.arithmetic != ArithmeticSwitch::plain || options_.stage == PassStage::vertex)
            return known;
        return options_.stage == PassStage::compute ? in_compute_stage(known, profile) : in_fragment_stage(known);
    }

    /// Items first to last, by the twin that at() made.
    template <class Made> void run_made(const Made& twin, const PassInput& in, const Profile& profile,
                                        std::size_t first, std::size_t last, const WritableView& after) const {
        const FlushSubnormals guard = flush(profile);
        const std::vector<item_twin::WordColumn> columns = item_twin::word_columns(after);
        with_arithmetic_of(profile, [&]<class A>(A fp) {
            Values<A> values(fp);
            using State = decltype(twin(values, in, first));
            if constexpr (!requires(const State& state) { state.size(); })
                item_twin::check_size(options_.name, after.about(), item_twin::numbers_in<State>());
            const auto make = [&](std::size_t item) {
                const State state = twin(values, in, item);
                if constexpr (requires { state.size(); })
                    item_twin::check_size(options_.name, after.about(), state.size());
                const item_twin::WordColumn* column = columns.data();
                item_twin::for_each_number(state, [&](const auto& x) {
                    const std::uint32_t word = item_twin::word_of(x);
                    std::memcpy(column->first + item * column->stride, &word, sizeof word);
                    ++column;
                });
            };
            std::vector<std::size_t> left;
            if (made_fast(twin, {in, profile, options_.arithmetic, first, last, after, left}))
                for (const std::size_t item : left)
                    make(item);
            else
                for (std::size_t item = first; item < last; ++item)
                    make(item);
        });
    }

    template <class Made> bool made_fast(const Made& twin, const FastRun& run) const {
        if constexpr (requires { twin.fast(run); }) {
            return twin.fast(run);
        } else {
            if (!options_.fast)
                return false;
            options_.fast(run.in, run.profile, run.first, run.last, run.after, run.left);
            return true;
        }
    }

    template <class Reading> void tell_of_driver(Reading& reading, const Profile& profile) const {
        if (profile.roots != nullptr)
            reading.take_roots_by_tables();
        const char* row =
            options_.stage == PassStage::compute ? "compute: a/c, c constant" : "a/c, c constant, precise";
        if (options_.arithmetic == ArithmeticSwitch::plain && !profile.follows(row))
            reading.open_constant_divisors();
    }

    [[nodiscard]] FlushSubnormals flush(const Profile& profile, bool known = true) const {
        if (options_.stage != PassStage::compute)
            return FlushSubnormals(known && profile.flush_subnormals);
        return {known && profile.compute_flush_subnormals,
                known && profile.compute_flush_results.value_or(profile.compute_flush_subnormals)};
    }

    template <class Work> decltype(auto) with_arithmetic_of(const Profile& profile, const Work& work) const {
        if (options_.arithmetic == ArithmeticSwitch::exact)
            return work(Portable{});
        return work(PlainArithmetic(profile));
    }

    template <class State>
    [[nodiscard]] std::vector<std::uint32_t> words_of(const State& state, const Resource& of) const {
        std::vector<std::uint32_t> words;
        item_twin::for_each_number(state, [&](const auto& x) { words.push_back(item_twin::word_of(x)); });
        item_twin::check_size(options_.name, of, words.size());
        return words;
    }

    template <class A>
    void tell(Worlds<A>& worlds, const View& observed, std::size_t item, std::vector<std::vector<float>>& kept) const {
        for (std::size_t f = 0; f < observed.fields().size(); ++f) {
            const Field& field = observed.fields()[f];
            if (field.scalar != Scalar::float32)
                continue;
            std::vector<float>& values = kept.emplace_back();
            for (int c = 0; c < field.components; ++c)
                values.push_back(observed.value(f, item, c).real());
        }
        std::size_t next = 0;
        for (std::size_t f = 0; f < observed.fields().size(); ++f)
            if (observed.fields()[f].scalar == Scalar::float32)
                worlds.tell(output(observed.about(), static_cast<std::uint8_t>(f)), kept[next++]);
    }

    static std::vector<OpenSite> open_sites(std::span<const Fork> forks) {
        std::vector<OpenSite> found;
        for (const Fork& fork : forks)
            for (const OpenDecision& decision : fork.decisions)
                if (decision.site != nullptr)
                    found.push_back({decision.site->label, decision.site->unit, decision.margin});
        return found;
    }

    /// One that is there already keeps the shorter way.
    static void add(std::vector<ItemOutcome>& outcomes, ItemOutcome outcome) {
        const auto same = [](const Interval& a, const Interval& b) {
            return a.any == b.any && (a.any || (a.low == b.low && a.high == b.high));
        };
        for (ItemOutcome& known : outcomes) {
            if (known.undefined != outcome.undefined || !std::equal(known.values.begin(), known.values.end(),
                                                                    outcome.values.begin(), outcome.values.end(), same))
                continue;
            if (outcome.open.size() < known.open.size())
                known = std::move(outcome);
            return;
        }
        outcomes.push_back(std::move(outcome));
    }

    ItemPassOptions options_;
    Twin twin_;
    bool is_prepared_ = false; ///< the twin is that of one input
};

template <class Twin> std::unique_ptr<ItemPass> item_pass(ItemPassOptions options, Twin twin) {
    return std::make_unique<ItemTwin<Twin>>(std::move(options), std::move(twin));
}

} // namespace lockstep
