#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <source_location>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "reference/legal_arithmetic.hpp"
#include "reference/model/image.hpp"
#include "reference/readings/any_order.hpp"
#include "reference/readings/condition.hpp"
#include "reference/readings/values.hpp"
#include "reference/undefined.hpp"

namespace lockstep {

/// A decision that legal rounding can take either way, and how far its operands are from the border, in the site's
/// unit.
struct OpenDecision {
    const Site* site = nullptr;
    double margin = 0.0;
    std::source_location where;
};

/// Where a run could have gone another way. The two decisions: what a choice among many left open, and on which
/// conditions; the second may be empty.
struct Fork {
    std::array<OpenDecision, 2> decisions;
};

/// A twin's every legal run (values.hpp says what a twin is): a number is the set of floats that GLSL's precision
/// rules, and what is known beyond them, allow. Where a decision may go either way, one way is taken and the step is
/// run again for the others, up to `most_runs`; beyond these it is undecided. What a decision says of its operands
/// holds for every copy of them from there on.
///
/// A run repeats what it shares with the one before from memory, so that a way more costs what comes after its fork.
template <class A> class Worlds {
  public:
    static constexpr int most_runs = 512;

    /// One float, or a handle to a set that the run owns.
    class Real : public Compared<Real> {
      public:
        Real() = default;
        Real(float x) : point_(x) {} // NOLINT: a float is one, as it stands

        [[nodiscard]] Interval set() const { return is_float() ? Interval(point_) : run_->values_[id_].set; }
        /// The set to judge a result by, whatever was told and gone on from.
        [[nodiscard]] Interval legal() const {
            return is_float() ? Interval(point_) : run_->values_[run_->values_[id_].legal].set;
        }
        [[nodiscard]] Undefined why() const { return is_float() ? Undefined::none : run_->values_[id_].why; }

        friend Real operator+(Real a, Real b) { return added(a, b); }
        friend Real operator-(Real a, Real b) { return subtracted(a, b); }
        friend Real operator*(Real a, Real b) { return chained(a, b); }
        friend Real operator-(Real a) { return negated(a); }

      private:
        friend class Worlds;
        Real(Worlds* run, float x) : run_(run), point_(x) {}
        Real(Worlds* run, std::uint32_t id) : run_(run), id_(id) {}
        [[nodiscard]] bool is_float() const { return id_ == no_id; }
        /// One value, not two of one set.
        [[nodiscard]] bool is_same(Real other) const { return !is_float() && id_ == other.id_; }
        static Worlds* run_of(Real a, Real b) { return a.run_ != nullptr ? a.run_ : b.run_; }
        static Real added(Real a, Real b) {
            if (const auto sum = of_floats(
                    a, b, [](auto x, auto y) { return x + y; }, is_exact_sum))
                return *sum;
            return run_of(a, b)->make({a, b}, [&](const auto& fp) { return fp.sum(a.set(), b.set()); });
        }
        static Real subtracted(Real a, Real b) {
            if (const auto difference = of_floats(
                    a, b, [](auto x, auto y) { return x - y; }, is_exact_difference))
                return *difference;
            return run_of(a, b)->make({a, b}, [&](const auto& fp) { return fp.difference(a.set(), b.set()); });
        }
        static Real multiplied(Real a, Real b) {
            if (const auto product = of_floats(
                    a, b, [](auto x, auto y) { return x * y; }, is_exact_product))
                return *product;
            return run_of(a, b)->make({a, b}, [&](const auto& fp) {
                return a.is_same(b) ? fp.square(a.set()) : fp.product(a.set(), b.set());
            });
        }
        /// Where the order of factors is open, a product remembers that it is one.
        static Real chained(Real a, Real b) {
            Worlds* run = run_of(a, b);
            if (run == nullptr || !run->known().factors_reordered)
                return multiplied(a, b);
            Real product = a.of_factors_ || b.of_factors_
                               ? run->make({a, b},
                                           [&](const auto& fp) {
                                               return a.is_same(b) ? fp.square_of_product(a.set())
                                                                   : fp.product_of_products(a.set(), b.set());
                                           })
                               : multiplied(a, b);
            product.of_factors_ = true;
            return product;
        }
        static Real negated(Real a) {
            Real result = a.is_float() ? Real(a.run_, static_cast<float>(-NumberOf<A>(a.point_)))
                                       : a.run_->make({a}, [&](const auto&) { return interval::negate(a.set()); });
            result.of_factors_ = a.of_factors_;
            return result;
        }
        // Both ways: of a large and a tiny one a double shows the error in one of them alone.
        static bool is_exact_sum(double a, double b, double sum) { return sum - a == b && sum - b == a; }
        static bool is_exact_difference(double a, double b, double difference) {
            return is_exact_sum(a, -b, difference);
        }
        static bool is_exact_product(double a, double b, double product) { return a * b == product; }
        /// The one float that an operation of two gives. `is_exact`: whether it rounds nothing, so that no order and no
        /// fusing changes it.
        template <class Operation> static std::optional<Real>
        of_floats(Real a, Real b, const Operation& operation, bool (*is_exact)(double a, double b, double result)) {
            if (!a.is_float() || !b.is_float())
                return {};
            Worlds* run = run_of(a, b);
            const auto result = static_cast<float>(operation(NumberOf<A>(a.point_), NumberOf<A>(b.point_)));
            const auto is_one = [&] {
                return run->is_free_ ? is_exact(a.point_, b.point_, result) : run->known().sums;
            };
            if (run != nullptr && !(run->is_sure(result) && is_one()))
                return {};
            return Real(run, result);
        }

        static constexpr std::uint32_t no_id = 0xffffffffU;
        Worlds* run_ = nullptr; ///< null: a number of the program's own
        std::uint32_t id_ = no_id;
        float point_ = 0.0F;
        bool of_factors_ = false; ///< a product or quotient, where the order of factors is open
    };

    using Int = int; ///< in each run there is one value
    using Vec2 = lockstep::Vec2<Real>;
    using Vec3 = lockstep::Vec3<Real>;
    using Vec4 = lockstep::Vec4<Real>;
    using IVec2 = lockstep::Vec2<int>;

    Worlds(A arithmetic, const KnownOperations& known, const OtherOrders& other_orders = {})
        : fp_(arithmetic), arithmetic_(arithmetic, known, other_orders),
          free_order_(arithmetic, {.sums = false, .subnormals = arithmetic_.known().subnormals}),
          of_sets_(arithmetic, without_roots(arithmetic_.known()), other_orders),
          one_order_(other_orders == OtherOrders()) {}
    Worlds(const Worlds&) = delete;
    Worlds& operator=(const Worlds&) = delete;

    /// What was captured of a shader's output: where it is legal and + - * are known, runs go on from it.
    void tell(std::string_view output, std::span<const float> values) { told_.push_back({name_id(output), values}); }

    /// The compiler may multiply by a constant's reciprocal (constant_divisor.hpp): where a division by others is
    /// known, one by a constant is either. A run divides by one constant in one way.
    void open_constant_divisors() { constant_divisors_open_ = known().divide; }

    /// The arithmetic's quotients and roots are a driver's own, by tables: known of floats, but of a set no more than
    /// GLSL says, since nothing promises that they rise with their operands.
    void take_roots_by_tables() { roots_by_tables_ = true; }

    /// Runs `twin` every way. At the end of each `ended(state, forks, undefined)` is called: the state, null where the
    /// run came to something open; the forks on the way, of type Fork; why something is open.
    template <class Twin, class Ended> void run(const Twin& twin, const Ended& ended) {
        values_.clear();
        log_.clear();
        path_.clear();
        forks_.clear();
        trail_.clear();
        for (int runs = 1; runs <= most_runs; ++runs) {
            next_value_ = next_answer_ = 0;
            by_reciprocal_.clear();
            try {
                const auto state = twin();
                ended(&state, forks(), open_field(state));
            } catch (const Ends& end) {
                ended(static_cast<decltype(twin())*>(nullptr), forks(), end.reason);
            }
            if (!next_way())
                return;
        }
        ended(static_cast<decltype(twin())*>(nullptr), std::span<const Fork>(), Undefined::undecided);
    }

    // The words of a twin.

    Real read(At, float x) {
        const float read = fp_.flush(x);
        if (is_sure(read))
            return Real(this, read);
        return make({}, [&](const auto& fp) { return fp.read(x); });
    }
    Vec3 read(At p, glm::vec3 v) { return {read(p, v.x), read(p, v.y), read(p, v.z)}; }
    Real uniform(At, float x) { return Real(this, x); }
    Vec3 uniform(At p, glm::vec3 v) { return {uniform(p, v.x), uniform(p, v.y), uniform(p, v.z)}; }
    static int uniform(At, int i) { return i; }
    static IVec2 uniform(At, glm::ivec2 v) { return {v.x, v.y}; }
    static const glm::mat4& uniform(At, const glm::mat4& m) { return m; }
    static bool setting(At, bool on) { return on; }

    template <class T> T note(At place, const T& value) {
        if constexpr (is_of_reals<T>())
            if (!told_.empty() && place.site.output_id != 0)
                for (const Told& told : told_)
                    if (told.output_id == place.site.output_id && known().sums)
                        return go_on_from(told.values, value);
        return value;
    }
    static bool decide(At, bool condition) { return condition; }
    template <bool all, std::size_t n> bool decide(At place, const OpenComparisons<Real, all, n>& condition) {
        if (next_answer_ < log_.size())
            return log_[next_answer_++] != 0;
        const Answer answer = ask(condition);
        if (answer.open != Undefined::none)
            throw Ends{answer.open};
        const bool yes = answer.yes;
        log_.push_back(yes ? 1 : 0);
        ++next_answer_;
        if (answer.yes && answer.no) {
            fork({{{{&place.site, answer.margin * place.site.per_unit, place.where}}}}, {1, 0});
            path_.back().question = {all, {condition.begin(), condition.end()}};
            learn(path_.back().question, true);
        }
        return yes;
    }
    bool decide(At place, const OpenComparison<Real>& condition) {
        return decide(place, OpenComparisons<Real, true, 1>{{condition}});
    }
    static IntRange<int> range(At, int first, int last) { return {first, last}; }
    template <class Texel>
    static const Texel* fetch(At place, const Image<Texel>& image, const IVec2& size, const IVec2& at) {
        return Values<A>::fetch(place, image, size, at);
    }

    static Real real(int i) { return static_cast<float>(i); }
    static Real real(std::uint32_t i) { return static_cast<float>(i); }
    int to_int(At place, Real x) {
        if (next_answer_ < log_.size())
            return log_[next_answer_++];
        const Interval v = x.set();
        if (v.any || !(std::abs(v.low) < 0x1p30 && std::abs(v.high) < 0x1p30))
            throw Ends{v.any ? x.why() : Undefined::unbounded};
        const double margin = std::min(std::abs(v.low - std::round(v.low)), std::abs(v.high - std::round(v.high)));
        return choose(place, static_cast<int>(v.low), static_cast<int>(v.high), margin);
    }
    // Where one float is known to come of floats, it needs no set.
    Real divide(At, Real a, Real b) {
        Real quotient = !known().factors_reordered || !(a.of_factors_ || b.of_factors_)
                            ? divided(a, b)
                            : make(
                                  {a, b}, [&](const auto& fp) { return fp.quotient_of_products(a.set(), b.set()); },
                                  Undefined::unbounded);
        quotient.of_factors_ = known().factors_reordered;
        return quotient;
    }
    bool by_reciprocal(At place, float c) {
        if (!constant_divisors_open_)
            return false;
        for (const auto& [known, answer] : by_reciprocal_)
            if (known == c)
                return answer;
        if (next_answer_ == log_.size()) {
            log_.push_back(0);
            fork({{{{&place.site, 0.0, place.where}}}}, {0, 1});
        }
        return by_reciprocal_.emplace_back(c, log_[next_answer_++] != 0).second;
    }
    Real sqrt(At, Real a) {
        if (known().square_root && !is_free_ && a.is_float())
            if (const float root = fp_.sqrt(a.point_); is_sure(root))
                return Real(this, root);
        return make({a}, [&](const auto& fp) { return fp.square_root(a.set()); });
    }
    Real min(Real a, Real b) {
        return ordered(a, b, [](double x, double y) { return y < x ? y : x; });
    }
    Real max(Real a, Real b) {
        return ordered(a, b, [](double x, double y) { return x < y ? y : x; });
    }
    Real abs(Real a) {
        return make({a}, [&](const auto&) { return interval::magnitude(a.set()); });
    }
    template <class Function> Real monotone(Real a, const Function& f) {
        if (a.is_float())
            return Real(this, f(a.point_));
        return make({a}, [&](const auto&) {
            const Interval v = a.set();
            return v.any ? v : Interval(double{f(static_cast<float>(v.low))}, double{f(static_cast<float>(v.high))});
        });
    }
    Real unspecified(At, Real value, float lowest, float highest) {
        return make({value}, [&](const auto&) { return Interval(double{lowest}, double{highest}); });
    }
    Real floor(Real a) {
        return make({a}, [&](const auto&) {
            const Interval v = a.set();
            return v.any || std::isnan(v.low) ? v : Interval(std::floor(v.low), std::floor(v.high));
        });
    }
    Real any_order_sum(At, std::span<const Real> terms) {
        return make({}, [&](const auto& fp) {
            std::vector<Interval> sets;
            for (const Real& term : terms)
                sets.push_back(term.set());
            return lockstep::any_order_sum(fp, sets);
        });
    }
    Real dot(At, const Vec3& a, const Vec3& b) {
        if (known().dot && one_order_ && are_floats(a) && are_floats(b))
            if (const float dot = fp_.dot(points(a), points(b)); is_a_number(dot))
                return Real(this, dot);
        return make({a.x, a.y, a.z, b.x, b.y, b.z}, [&](const auto&) {
            const Interval3 x = sets(a), y = sets(b);
            if (known().dot && are_floats(a) && are_floats(b))
                return arithmetic_.dot(points(a), points(b));
            Interval sum = free_order_.product(x[0], y[0]);
            for (std::size_t c = 1; c < 3; ++c)
                sum = free_order_.sum(sum, free_order_.product(x[c], y[c]));
            return interval::to_floats(sum);
        });
    }
    Real length(At, const Vec3& v) {
        if (known().dot && known().square_root && one_order_ && are_floats(v))
            if (const float length = fp_.length(points(v)); is_a_number(length))
                return Real(this, length);
        return make({v.x, v.y, v.z}, [&](const auto& fp) { return fp.length(sets(v)); });
    }
    Vec3 normalize(At, const Vec3& v) {
        return make_all<Vec3>(
            v, [&](const auto& fp) { return fp.normalize(sets(v)); }, Undefined::zero_direction);
    }
    Vec4 transform(At, const glm::mat4& m, const Vec3& v) {
        if (known().sums && known().subnormals && are_floats(v)) {
            const glm::vec4 t = fp_.transform(m, points(v));
            if (is_a_number(t.x) && is_a_number(t.y) && is_a_number(t.z) && is_a_number(t.w))
                return {Real(this, t.x), Real(this, t.y), Real(this, t.z), Real(this, t.w)};
        }
        return make_all<Vec4>(v, [&](const auto& fp) { return fp.transform(m, sets(v)); });
    }

    /// Whether a condition may be answered with yes, and with no.
    static std::pair<bool, bool> ways(const auto& condition) {
        const Answer answer = ask(condition);
        return {answer.yes, answer.no};
    }

    /// Yes, no, or either.
    struct Answer {
        bool yes = false, no = false;
        Undefined open = Undefined::none;
        double margin = HUGE_VAL;

        /// With another part of a condition.
        template <bool all> void combine(const Answer& other) {
            yes = all ? yes && other.yes : yes || other.yes;
            no = all ? no || other.no : no && other.no;
            margin = std::min(margin, other.margin);
            open = yes && no ? first_of(open, other.open) : Undefined::none;
        }
    };

    /// One outcome for each that no other surely beats, and for none where none is sure: `<` lets an earlier one win
    /// over an equally near later one.
    template <class Payload> class Least {
      public:
        Least(Worlds& run, At place, float first) : run_(run), place_(place), first_(first) {}

        template <class Condition> void offer(At place, const Condition& condition, Real key, const Payload& payload) {
            const int number = offered_++;
            Answer answer = ask(condition);
            answer.template combine<true>(ask(key < Real(first_)));
            // Where the choice is made already, what was chosen is wanted, whatever decisions since say of it.
            if (answer.yes || run_.next_answer_ < run_.log_.size())
                rivals_.push_back({number, key.set(), answer, payload});
            if (answer.yes && answer.no && answer.open == Undefined::none && answer.margin < border_.margin)
                border_ = {&place.site, answer.margin, place.where};
        }

        [[nodiscard]] std::optional<Payload> take() {
            if (run_.next_answer_ == run_.log_.size())
                choose();
            const int chosen = run_.log_[run_.next_answer_++];
            for (const Rival& rival : rivals_) {
                if (rival.number == chosen)
                    return rival.payload;
                if (chosen == of_open && rival.answer.open != Undefined::none)
                    throw Ends{rival.answer.open};
            }
            return {};
        }

      private:
        struct Rival {
            int number; ///< of the offer
            Interval key;
            Answer answer;
            Payload payload;
            [[nodiscard]] bool is_open() const { return answer.open != Undefined::none; }
            [[nodiscard]] bool is_sure() const { return !answer.no; }
        };

        void choose() {
            std::vector<int> ways;
            double gap = HUGE_VAL;
            bool sure = false, open = false;
            const Rival* first = nullptr;
            for (const Rival& rival : rivals_) {
                sure = sure || rival.is_sure();
                open = open || rival.is_open();
                if (!rival.answer.yes || rival.is_open() ||
                    std::any_of(rivals_.begin(), rivals_.end(), [&](const Rival& r) { return beats(r, rival); }))
                    continue;
                ways.push_back(rival.number);
                if (first != nullptr)
                    gap = std::min(gap, std::abs(interval::middle(rival.key) - interval::middle(first->key)));
                else
                    first = &rival;
            }
            if (open)
                ways.push_back(of_open);
            if (!sure)
                ways.push_back(of_none);
            run_.log_.push_back(ways.front());
            if (ways.size() == 1)
                return;
            Fork fork;
            std::size_t count = 0;
            if (border_.site != nullptr)
                fork.decisions[count++] = {border_.site, border_.margin * border_.site->per_unit, border_.where};
            if (gap < HUGE_VAL)
                fork.decisions[count++] = {&place_.site, gap * place_.site.per_unit, place_.where};
            run_.fork(fork, std::move(ways));
        }
        static bool beats(const Rival& a, const Rival& b) {
            if (&a == &b || !a.is_sure())
                return false;
            return a.number < b.number ? a.key.high <= b.key.low : a.key.high < b.key.low;
        }

        static constexpr int of_none = -1, of_open = -2;
        Worlds& run_;
        At place_;
        float first_;
        int offered_ = 0;
        std::vector<Rival> rivals_;
        OpenDecision border_{nullptr, HUGE_VAL, {}};
    };

  protected:
    [[nodiscard]] const KnownOperations& known() const { return arithmetic_.known(); }
    /// Whether the operations from here on may be taken in another order, fused and computed twice: those of a text
    /// without `precise`.
    void set_free(bool is_free) {
        is_free_ = is_free;
        was_free_ = was_free_ || is_free;
    }
    /// Ends this run: from here on anything goes.
    [[noreturn]] static void end(Undefined reason) { throw Ends{reason}; }
    /// Each integer from first to last is a way, where these are few. `margin`: as of OpenDecision.
    int choose(At place, int first, int last, double margin) {
        constexpr int most_ways = 4;
        if (next_answer_ < log_.size())
            return log_[next_answer_++];
        if (last - first >= most_ways)
            throw Ends{Undefined::unbounded};
        log_.push_back(first);
        ++next_answer_;
        if (first != last) {
            std::vector<int> ways;
            for (int i = first; i <= last; ++i)
                ways.push_back(i);
            fork({{{{&place.site, margin * place.site.per_unit, place.where}}}}, std::move(ways));
        }
        return first;
    }
    template <class Compute>
    Real make(std::initializer_list<Real> operands, const Compute& compute, Undefined own = Undefined::not_a_number) {
        const auto id = static_cast<std::uint32_t>(next_value_++);
        if (values_.empty())
            values_.reserve(128);
        if (id == values_.size())
            put(compute(arithmetic_of(operands)), operands, own);
        return at(id);
    }

  private:
    struct Value {
        Interval set;
        std::uint32_t legal;             ///< where the set lies that this is judged by: most often here
        Undefined why = Undefined::none; ///< where anything goes
        bool is_float = false;           ///< made of floats, and one itself
    };
    struct Ends {
        Undefined reason;
    };
    struct Told {
        std::uint32_t output_id;
        std::span<const float> values;
    };
    /// What a decision asked.
    struct Question {
        bool all = true;
        std::vector<OpenComparison<Real>> parts;
    };
    /// A fork of this run, and what there was of the run when it came to it.
    struct Node {
        std::vector<int> ways;
        Question question;
        std::size_t taken, values, answers, trail;
    };

    /// Every NaN is one value where the arithmetic is the project's own; else GL leaves it open.
    static bool is_a_number(float result) { return flushes<A> || !std::isnan(result); }
    /// Whether an operation of floats that gives this gives nothing else: subnormals may be flushed.
    [[nodiscard]] bool is_sure(float result) const {
        return is_a_number(result) &&
               (known().subnormals || result == 0.0F || std::abs(result) >= std::numeric_limits<float>::min());
    }
    static bool are_floats(const Vec3& v) { return v.x.is_float() && v.y.is_float() && v.z.is_float(); }
    static glm::vec3 points(const Vec3& v) { return {v.x.point_, v.y.point_, v.z.point_}; }

    Real divided(Real a, Real b) {
        if (known().divide && !is_free_ && a.is_float() && b.is_float())
            if (const float quotient = fp_.divide(a.point_, b.point_); is_sure(quotient))
                return Real(this, quotient);
        return make(
            {a, b}, [&](const auto& fp) { return fp.divide(a.set(), b.set()); }, Undefined::unbounded);
    }
    /// min and max: exact, but GL leaves open what they make of NaN.
    template <class Pick> Real ordered(Real a, Real b, const Pick& pick) {
        return make({a, b}, [&](const auto&) {
            const Interval x = a.set(), y = b.set();
            if (x.any || y.any || std::isnan(x.low) || std::isnan(y.low))
                return Interval::anything();
            return Interval(pick(x.low, y.low), pick(x.high, y.high));
        });
    }
    static KnownOperations without_roots(KnownOperations known) {
        known.divide = known.square_root = known.normalize = false;
        return known;
    }
    [[nodiscard]] const LegalArithmetic<A>& arithmetic_of(std::initializer_list<Real> operands) const {
        if (is_free_)
            return free_order_;
        const auto is_point = [](const Real& x) { return x.set().is_point(); };
        return roots_by_tables_ && !std::all_of(operands.begin(), operands.end(), is_point) ? of_sets_ : arithmetic_;
    }
    template <class Vector, class Compute>
    Vector make_all(const Vec3& operand, const Compute& compute, Undefined own = Undefined::not_a_number) {
        if (next_value_ == values_.size())
            for (const Interval& set : compute(arithmetic_of({operand.x, operand.y, operand.z})))
                put(set, {operand.x, operand.y, operand.z}, own);
        Vector vector;
        std::apply([&](auto&... field) { ((field = at(static_cast<std::uint32_t>(next_value_++))), ...); },
                   vector.fields());
        return vector;
    }
    void put(const Interval& set, std::initializer_list<Real> operands, Undefined own) {
        Value value{set, static_cast<std::uint32_t>(values_.size())};
        value.is_float = set.is_point();
        for (const Real& operand : operands)
            value.is_float = value.is_float && operand.is_float();
        if (set.any) {
            for (const Real& operand : operands)
                value.why = value.why == Undefined::none ? operand.why() : value.why;
            value.why = value.why == Undefined::none ? own : value.why;
        }
        values_.push_back(value);
    }
    /// A float is no handle: no answer can say more of it.
    Real at(std::uint32_t id) {
        const Value& value = values_[id];
        return value.is_float ? Real(this, value.set.as_float()) : Real(this, id);
    }
    static Undefined first_of(Undefined a, Undefined b) { return a != Undefined::none ? a : b; }
    static Interval3 sets(const Vec3& v) { return {v.x.set(), v.y.set(), v.z.set()}; }

    template <class Field> static Undefined open_field(const Field& field) {
        if constexpr (std::is_same_v<Field, Real>)
            return field.why();
        else if constexpr (std::is_integral_v<Field>)
            return Undefined::none;
        else if constexpr (requires { field.word; })
            return field.set.any ? Undefined::not_a_number : Undefined::none;
        else if constexpr (requires { field.size(); }) {
            Undefined reason = Undefined::none;
            field.for_each([&](const auto& part) { reason = first_of(reason, open_field(part)); });
            return reason;
        } else {
            Undefined reason = Undefined::none;
            std::apply([&](const auto&... part) { ((reason = first_of(reason, open_field(part))), ...); },
                       field.fields());
            return reason;
        }
    }

    static Answer ask(const OpenComparison<Real>& c) {
        using Op = CompareOp;
        if (c.op == Op::always || c.op == Op::never) {
            const bool yes = (c.op == Op::always) != c.negated;
            return {yes, !yes};
        }
        const Interval a = c.a.set(), b = c.b.set();
        if (a.any || b.any)
            return {true, true, first_of(first_of(c.a.why(), c.b.why()), Undefined::not_a_number)};
        Answer answer{};
        if (std::isnan(a.low) || std::isnan(b.low))
            answer = {false, true};
        else if (c.op == Op::less)
            answer = {a.low < b.high, a.high >= b.low};
        else if (c.op == Op::less_equal)
            answer = {a.low <= b.high, a.high > b.low};
        else
            answer = {a.low <= b.high && b.low <= a.high, !(a.low == a.high && b.low == b.high && a.low == b.low)};
        if (c.negated)
            std::swap(answer.yes, answer.no);
        if (answer.yes && answer.no)
            answer.margin = std::abs(interval::middle(a) - interval::middle(b));
        return answer;
    }
    template <bool all, std::size_t n> static Answer ask(const OpenComparisons<Real, all, n>& condition) {
        Answer whole = ask(condition.part[0]);
        for (std::size_t i = 1; i < n; ++i)
            whole.template combine<all>(ask(condition.part[i]));
        return whole;
    }
    static Answer ask(bool known) { return {known, !known}; }

    void fork(const Fork& open, std::vector<int> ways) {
        forks_.push_back(open);
        // The answer is in the log already, or is about to be read there.
        path_.push_back({std::move(ways), {}, 0, values_.size(), log_.size() - 1, trail_.size()});
    }
    std::span<const Fork> forks() const { return forks_; }

    bool next_way() {
        while (!path_.empty() && path_.back().taken + 1 == path_.back().ways.size()) {
            path_.pop_back();
            forks_.pop_back();
        }
        if (path_.empty())
            return false;
        Node& node = path_.back();
        ++node.taken;
        for (; trail_.size() > node.trail; trail_.pop_back())
            values_[trail_.back().first].set = trail_.back().second;
        values_.resize(node.values);
        log_.resize(node.answers + 1);
        log_.back() = node.ways[node.taken];
        learn(node.question, log_.back() != 0);
        return true;
    }

    /// What an answer says of the operands. Not where + - * are free: what is not `precise` may be computed twice.
    void learn(const Question& question, bool answer) {
        if (!known().sums || was_free_)
            return;
        // Of "not all", or "any", only what is left when every other part is settled is known.
        const bool each = question.all == answer;
        const OpenComparison<Real>* only = nullptr;
        for (const OpenComparison<Real>& part : question.parts) {
            const Answer one = ask(part);
            if (one.yes != one.no)
                continue;
            if (each)
                hold(part, answer);
            else if (only != nullptr)
                return;
            only = &part;
        }
        if (!each && only != nullptr)
            hold(*only, answer);
    }
    void hold(const OpenComparison<Real>& c, bool answer) {
        using Op = CompareOp;
        const bool holds = answer != c.negated;
        const bool strict = c.op == Op::less;
        if (c.op != Op::less && c.op != Op::less_equal)
            return;
        if (holds)
            below(c.a, c.b, strict);
        else
            below(c.b, c.a, !strict);
    }
    /// Not among subnormals: the next operation may flush what this one did not.
    void below(Real a, Real b, bool strictly) {
        constexpr double smallest = std::numeric_limits<float>::min();
        const Interval x = a.set(), y = b.set();
        const double high = strictly ? std::nextafter(static_cast<float>(y.high), -HUGE_VALF) : y.high;
        const double low = strictly ? std::nextafter(static_cast<float>(x.low), HUGE_VALF) : x.low;
        if (high < x.high && high >= x.low && std::abs(high) >= smallest)
            cut(a, {x.low, high});
        if (low > y.low && low <= y.high && std::abs(low) >= smallest)
            cut(b, {low, y.high});
    }
    void cut(Real x, Interval set) {
        if (x.is_float())
            return;
        trail_.emplace_back(x.id_, values_[x.id_].set);
        values_[x.id_].set = set;
    }

    /// Numbers, not integers: these are decided, and so told already.
    template <class T> static constexpr bool is_of_reals() {
        return std::is_same_v<T, Real> || std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3> || std::is_same_v<T, Vec4>;
    }
    Real go_on_from(std::span<const float> told, const Real& value) {
        return agree(value.set().contains(told[0])) ? instead_of(value, told[0]) : value;
    }
    template <class Vector> Vector go_on_from(std::span<const float> told, const Vector& v) {
        const bool legal = std::apply(
            [&](const auto&... part) {
                std::size_t c = 0;
                return (part.set().contains(told[c++]) && ...);
            },
            v.fields());
        if (!agree(legal))
            return v;
        Vector observed = v;
        std::size_t c = 0;
        std::apply([&](auto&... part) { ((part = instead_of(part, told[c++])), ...); }, observed.fields());
        return observed;
    }
    /// An answer like a decision's: a run that is repeated must not ask again.
    bool agree(bool answer) {
        if (next_answer_ == log_.size())
            log_.push_back(answer ? 1 : 0);
        return log_[next_answer_++] != 0;
    }
    Real instead_of(Real value, float told) {
        if (value.is_float())
            return value;
        const auto id = static_cast<std::uint32_t>(next_value_++);
        if (id == values_.size())
            values_.push_back({arithmetic_.read(told), value.id_, value.why()});
        return {this, id};
    }

    A fp_;
    LegalArithmetic<A> arithmetic_, free_order_; ///< as known, and with + - * in any order
    LegalArithmetic<A> of_sets_;                 ///< as known, but for roots and quotients
    bool roots_by_tables_ = false;
    bool is_free_ = false, was_free_ = false;
    bool one_order_; ///< no others of sums in dot, length and normalize
    bool constant_divisors_open_ = false;
    std::vector<Told> told_;
    std::vector<Value> values_; ///< of this run, and of the one before up to where they part
    std::vector<int> log_;      ///< answers, likewise
    std::size_t next_value_ = 0, next_answer_ = 0;
    std::vector<std::pair<float, bool>> by_reciprocal_; ///< of this run
    std::vector<Node> path_;
    std::vector<Fork> forks_;                               ///< one for each of path_
    std::vector<std::pair<std::uint32_t, Interval>> trail_; ///< sets as they were before an answer cut them
};

} // namespace lockstep
