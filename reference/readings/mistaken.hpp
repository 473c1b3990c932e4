#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include <glm/matrix.hpp>

#include "reference/readings/changed.hpp"
#include "reference/readings/condition.hpp"
#include "reference/readings/mistake.hpp"
#include "reference/readings/values.hpp"

namespace lockstep {

/// An arithmetic whose a * b + c rounds once.
template <class A> struct FusedProducts : A {
    explicit FusedProducts(const A& arithmetic) : A(arithmetic) {}
    static glm::vec4 transform(const glm::mat4& m, glm::vec3 v) {
        const auto row = [&](int r) { return std::fma(m[2][r], v.z, std::fma(m[1][r], v.y, m[0][r] * v.x)) + m[3][r]; };
        return {row(0), row(1), row(2), row(3)};
    }
};
template <class A> constexpr bool fuses = false;
template <class A> constexpr bool fuses<FusedProducts<A>> = true;

/// Computes as Values does, but for the mistakes made. One site may have several.
template <class A> class Mistaken {
  public:
    class Real : public Compared<Real> {
      public:
        Real() = default;
        Real(float x) : value_(x) {} // NOLINT: a float is one
        explicit operator float() const { return value_; }
        friend Real operator+(const Real& a, const Real& b) { return a.plus(b, 1.0F); }
        friend Real operator-(const Real& a, const Real& b) { return a.plus(b, -1.0F); }
        friend Real operator-(const Real& a) { return A::flush(-a.value_); }
        friend Real operator*(const Real& a, const Real& b) {
            Real product = static_cast<float>(NumberOf<A>(a.value_) * NumberOf<A>(b.value_));
            if constexpr (fuses<A>)
                product.factors_ = {a.value_, b.value_}, product.is_product_ = true;
            return product;
        }

      private:
        [[nodiscard]] Real plus(const Real& b, float sign) const {
            if constexpr (fuses<A>) {
                if (is_product_)
                    return std::fma(factors_.a, factors_.b, sign * b.value_);
                if (b.is_product_)
                    return std::fma(sign * b.factors_.a, b.factors_.b, value_);
            }
            return A::flush(sign > 0.0F ? value_ + b.value_ : value_ - b.value_);
        }
        struct Factors {
            float a = 0.0F, b = 0.0F;
        };
        template <int> struct None {};
        float value_ = 0.0F;
        [[no_unique_address]] std::conditional_t<fuses<A>, Factors, None<0>> factors_;
        [[no_unique_address]] std::conditional_t<fuses<A>, bool, None<1>> is_product_{};
    };
    class Int {
      public:
        Int() = default;
        Int(int i) : value_(i) {}               // NOLINT: an int is one
        operator int() const { return value_; } // NOLINT: and is one again
        friend Int operator+(Int a, Int b) { return a.value_ + b.value_; }
        friend Int operator+(Int a, int b) { return a.value_ + b; }
        friend Int operator-(Int a, Int b) { return a.value_ - b.value_; }
        friend Int operator-(Int a, int b) { return a.value_ - b; }
        friend Int operator*(Int a, Int b) { return a.value_ * b.value_; }
        friend Int operator*(Int a, int b) { return a.value_ * b; }
        friend Int operator-(Int a) { return -a.value_; }
        friend OpenComparison<Real> operator==(Int a, int b) {
            return Real(static_cast<float>(a.value_)) == Real(static_cast<float>(b));
        }

      private:
        int value_ = 0;
    };
    using Vec2 = lockstep::Vec2<Real>;
    using Vec3 = lockstep::Vec3<Real>;
    using Vec4 = lockstep::Vec4<Real>;
    using IVec2 = lockstep::Vec2<Int>;

    /// A loop's turns, which end where the loop is left.
    class Turns : public IntRange<Int> {
      public:
        Turns(Mistaken& reading, IntRange<Int> turns)
            : IntRange<Int>(turns), reading_(reading), depth_(++reading.loops_open_) {}
        Turns(const Turns&) = delete;
        Turns& operator=(const Turns&) = delete;
        ~Turns() {
            if (reading_.left_from_ == reading_.loops_open_--)
                reading_.left_from_ = never_left;
        }
        struct Iterator {
            typename IntRange<Int>::Iterator at;
            const Turns& of;
            Int operator*() const { return *at; }
            Iterator& operator++() { return ++at, *this; }
            bool operator!=(const Iterator& end) const { return at != end.at && of.depth_ < of.reading_.left_from_; }
        };
        [[nodiscard]] Iterator begin() const { return {IntRange<Int>::begin(), *this}; }
        [[nodiscard]] Iterator end() const { return {IntRange<Int>::end(), *this}; }

      private:
        Mistaken& reading_;
        int depth_;
    };

    Mistaken(A arithmetic, std::span<const Mistake> made) : fp_(arithmetic) {
        for (const Mistake& mistake : made)
            for (const Mistake* one = &mistake; one != nullptr && count_ < made_.size(); one = one->also) {
                made_[count_].mistake = *one;
                made_[count_++].mistake.constants = mistake.constants;
                touched_ |= bit(one->site) | bit(one->source);
                if (one->formula != nullptr && !run_)
                    run_.emplace();
            }
    }

    /// What formulas may ask of the system, whatever a run comes by.
    template <class World> void foretell(const World& world) {
        if (run_)
            run_->world = &world;
    }

    void is_of_item(std::size_t item) {
        if (run_)
            run_->item = item;
    }

    /// From here on, writes down what sites it comes by, each kind of site once.
    void look_at_sites() { looks_ = true; }
    [[nodiscard]] std::span<const SeenSite> sites() const { return sites_; }

    // The words of a twin.

    Real read(At p, float x) { return note(p, Real(fp_.flush(x))); }
    Vec3 read(At p, glm::vec3 v) { return note(p, vector(fp_.flush(v))); }
    Real uniform(At p, float x) { return note(p, Real(x)); }
    Vec3 uniform(At p, glm::vec3 v) { return note(p, vector(v)); }
    Int uniform(At p, int i) { return note(p, Int(i)); }
    IVec2 uniform(At p, glm::ivec2 v) { return note(p, IVec2{v.x, v.y}); }
    glm::mat4 uniform(At p, const glm::mat4& m) {
        see(p, Kind::matrix);
        return change_at(p) == Change::transposed ? glm::transpose(m) : m;
    }
    bool setting(At p, bool on) { return known(p, on, Kind::setting); }

    template <class T> T note(At p, T value) {
        constexpr bool whole = std::is_same_v<T, Int> || std::is_same_v<T, IVec2>;
        see(p, whole ? Kind::whole_value : Kind::value, static_cast<int>(parts(value).size()));
        if (!is_untouched(p))
            for (Made& made : std::span(made_.data(), count_)) {
                if (p.site.id == made.mistake.source)
                    keep(made, value);
                if (p.site.id == made.mistake.site)
                    spoil(made, value);
            }
        if (run_)
            came_by(p, value);
        return value;
    }
    bool decide(At p, bool condition) {
        if (const Made* made = formula_at(p, Change::decided_by_formula)) {
            std::array<float, 1> answer{condition ? 1.0F : 0.0F};
            ask(*made, answer);
            return answer[0] != 0.0F;
        }
        return known(p, condition, Kind::condition);
    }
    bool decide(At p, const OpenComparison<Real>& condition) {
        return holds(p, OpenComparisons<Real, true, 1>{{condition}});
    }
    template <bool all, std::size_t n> bool decide(At p, const OpenComparisons<Real, all, n>& condition) {
        return holds(p, condition);
    }
    Turns range(At p, int first, int last) {
        see(p, Kind::loop);
        ++loops_begun_;
        const Made* made = formula_at(p, Change::ranged_by_formula);
        return {*this,
                made != nullptr ? asked_turns(*made, first, last) : changed_turns<Int>(change_at(p), first, last)};
    }
    /// Outside the image, where only a wrong size leads, drivers answer 0.
    template <class Texel> const Texel* fetch(At p, const Image<Texel>& image, const IVec2& size, const IVec2& at) {
        see(p, Kind::fetch);
        int x = at.x, y = at.y;
        if (const Made* made = formula_at(p, Change::fetched_by_formula)) {
            std::array<float, 4> place{static_cast<float>(x), static_cast<float>(y), static_cast<float>(size.x),
                                       static_cast<float>(size.y)};
            ask(*made, place);
            x = static_cast<int>(place[0]);
            y = static_cast<int>(place[1]);
        }
        if (!(x >= 0 && y >= 0 && x < size.x && y < size.y)) {
            switch (change_at(p)) {
            case Change::outside_is_edge:
                x = std::clamp(x, 0, image.width - 1);
                y = std::clamp(y, 0, image.height - 1);
                break;
            case Change::outside_is_other_side:
                x = ((x % image.width) + image.width) % image.width;
                y = ((y % image.height) + image.height) % image.height;
                break;
            case Change::outside_is_zero:
                return &zero_but_alpha;
            default:
                leave(change_at(p), false);
                return nullptr;
            }
        }
        const Texel* texel = image.contains(x, y) ? &image.at(x, y) : &zero;
        if constexpr (std::is_same_v<Texel, glm::vec4>)
            if (run_)
                run_->keep(p.site.id, std::array{texel->x, texel->y, texel->z, texel->w});
        return texel;
    }

    static Real real(Int i) { return static_cast<float>(static_cast<int>(i)); }
    static Real real(int i) { return static_cast<float>(i); }
    static Real real(std::uint32_t i) { return static_cast<float>(i); }
    static Int to_int(At, Real x) { return static_cast<int>(static_cast<float>(x)); }
    Real divide(At p, Real a, Real b) {
        see(p, Kind::optional_operation);
        return change_at(p) == Change::not_done ? a : Real(fp_.divide(static_cast<float>(a), static_cast<float>(b)));
    }
    Real sqrt(At p, Real a) {
        see(p, Kind::optional_operation);
        return change_at(p) == Change::not_done ? a : Real(fp_.sqrt(static_cast<float>(a)));
    }
    static Real min(Real a, Real b) { return static_cast<float>(b) < static_cast<float>(a) ? b : a; }
    static Real max(Real a, Real b) { return static_cast<float>(a) < static_cast<float>(b) ? b : a; }
    static Real abs(Real a) { return std::abs(static_cast<float>(a)); }
    template <class Function> static Real monotone(Real a, const Function& f) { return f(static_cast<float>(a)); }
    static Real unspecified(At, Real value, float /*lowest*/, float /*highest*/) { return value; }
    static Real floor(Real a) { return std::floor(static_cast<float>(a)); }
    static Real any_order_sum(At, std::span<const Real> terms) {
        Real sum(0.0F);
        for (const Real& term : terms)
            sum = sum + term;
        return sum;
    }
    Real dot(At, const Vec3& a, const Vec3& b) const { return fp_.dot(floats(a), floats(b)); }
    Real length(At p, const Vec3& v) {
        see(p, Kind::length);
        glm::vec3 f = floats(v);
        switch (change_at(p)) {
        case Change::squared:
            return fp_.dot(f, f);
        case Change::sum_of_magnitudes:
            return (std::abs(f.x) + std::abs(f.y)) + std::abs(f.z);
        case Change::without_x:
            f.x = 0.0F;
            break;
        case Change::without_y:
            f.y = 0.0F;
            break;
        case Change::without_z:
            f.z = 0.0F;
            break;
        default:
            break;
        }
        return fp_.length(f);
    }
    Vec3 normalize(At p, const Vec3& v) {
        see(p, Kind::optional_operation);
        return change_at(p) == Change::not_done ? v : vector(fp_.normalize(floats(v)));
    }
    Vec4 transform(At, const glm::mat4& m, const Vec3& v) const {
        const glm::vec4 t = fp_.transform(m, floats(v));
        return {t.x, t.y, t.z, t.w};
    }

  private:
    struct Made {
        Mistake mistake;
        std::array<float, 4> kept{}; ///< the source's value, in this run
        std::size_t kept_size = 0;
    };

  public:
    template <class Payload> class Least {
      public:
        Least(Mistaken& reading, At place, float first)
            : reading_(reading), place_(place), change_(reading.change_at(place)),
              made_(reading.formula_at(place, Change::chosen_by_formula)), least_(first) {
            reading.see(place, Kind::choice);
            reading.begin_choice();
        }
        template <class Condition>
        void offer(At place, const Condition& condition, const Real& key, const Payload& payload) {
            if (!reading_.decide(place, condition))
                return;
            reading_.count_offer();
            std::array<float, 2> by{static_cast<float>(key), 0.0F};
            if (made_ != nullptr)
                reading_.ask(*made_, by);
            if (!better(by[0]) && !(found_ && by[0] == least_ && by[1] < of_equals_))
                return pass_over(by[0], payload);
            second_key_ = least_;
            if (!(change_ == Change::compared_with_first && found_))
                least_ = by[0];
            of_equals_ = by[1];
            turn_ = reading_.loops_begun_;
            reading_.choose();
            if (change_ == Change::second_least)
                second_ = found_;
            if (adds() && found_)
                return reading_.add(*found_, std::optional(payload), change_);
            found_ = payload;
            if (adds())
                reading_.add(*found_, std::optional<Payload>(), change_);
        }
        [[nodiscard]] const std::optional<Payload>& take() {
            if (const Made* made = reading_.formula_at(place_, Change::found_by_formula); made != nullptr && found_) {
                std::array<float, 1> counts{1.0F};
                reading_.ask(*made, counts);
                if (counts[0] == 0.0F)
                    found_.reset();
            }
            return second_ ? second_ : found_;
        }

      private:
        [[nodiscard]] bool adds() const {
            return change_ >= Change::added_up && change_ <= Change::improving_units_added_up;
        }
        [[nodiscard]] bool better(float key) const {
            switch (change_) {
            case Change::last_taken:
                return true;
            case Change::first_taken:
                return !found_;
            case Change::greatest_taken:
                return !found_ || key > least_;
            case Change::last_of_equals:
                return key <= least_;
            case Change::one_a_turn:
                return key < least_ && !(found_ && turn_ == reading_.loops_begun_);
            case Change::added_up:
            case Change::units_added_up:
                return true;
            default:
                return key < least_;
            }
        }
        void pass_over(float key, const Payload& payload) {
            if (change_ == Change::compared_with_last)
                least_ = key;
            if (change_ == Change::second_least && (!second_ || key < second_key_)) {
                second_ = payload;
                second_key_ = key;
            }
        }
        Mistaken& reading_;
        At place_;
        Change change_;
        const Made* made_;
        float least_;
        float of_equals_ = 0.0F; ///< what chose among those whose key is the least
        int turn_ = 0;
        std::optional<Payload> found_, second_;
        float second_key_ = 0.0F;
    };

  private:
    using Kind = SeenSite::Kind;

    static Vec3 vector(glm::vec3 v) { return {v.x, v.y, v.z}; }

    void see(At p, Kind kind, int size = 1) {
        if (!looks_)
            return;
        const SeenSite seen{&p.site, kind, size, loops_open_};
        if (std::find(sites_.begin(), sites_.end(), seen) == sites_.end())
            sites_.push_back(seen);
    }
    /// Most sites have nothing made of them: a bit of their name says so at once.
    static std::uint64_t bit(std::uint32_t site) { return std::uint64_t{1} << (site % 64); }
    [[nodiscard]] bool is_untouched(At p) const { return (touched_ & bit(p.site.id)) == 0; }

    /// The operation's change; a value's are made by note().
    [[nodiscard]] Change change_at(At p) const {
        if (is_untouched(p))
            return Change::none;
        for (const Made& made : std::span(made_.data(), count_))
            if (made.mistake.site == p.site.id && made.mistake.change > Change::found_by_formula)
                return made.mistake.change;
        return Change::none;
    }

    IntRange<Int> asked_turns(const Made& made, int first, int last) {
        std::array<float, 3> loop{static_cast<float>(first), static_cast<float>(last), 1.0F};
        ask(made, loop);
        const int from = static_cast<int>(loop[0]), step = std::max(static_cast<int>(loop[2]), 1);
        const int turns = static_cast<int>(loop[1]) < from ? -1 : (static_cast<int>(loop[1]) - from) / step;
        return {from, from + turns * step, step};
    }
    /// What becomes of the loops around a condition, or a fetch, that answers so.
    void leave(Change change, bool answer) {
        if (change == (answer ? Change::loop_left_if_so : Change::loop_left_if_not))
            left_from_ = std::min(left_from_, loops_open_);
        if (change == (answer ? Change::loops_left_if_so : Change::loops_left_if_not))
            left_from_ = 1;
    }

    /// The mistake there that a formula says, of one kind.
    [[nodiscard]] const Made* formula_at(At p, Change kind) const {
        if (!run_ || is_untouched(p))
            return nullptr;
        for (const Made& made : std::span(made_.data(), count_))
            if (made.mistake.site == p.site.id && made.mistake.change == kind)
                return &made;
        return nullptr;
    }
    void begin_choice() {
        chosen_.reset();
        if (run_)
            run_->offered = run_->taken = 0;
    }
    void count_offer() {
        if (run_)
            ++run_->offered;
    }
    void choose() {
        if (!run_)
            return;
        ++run_->taken;
        chosen_ = run_;
    }
    void ask(const Made& made, std::span<float> value) {
        run_->chosen = chosen_ ? &*chosen_ : nullptr;
        run_->constants = made.mistake.constants;
        made.mistake.formula(value, *run_);
    }
    template <class T> void came_by(At p, const T& value) {
        const auto all = parts(value);
        std::array<float, CameBy::most_values> v{};
        for (std::size_t i = 0; i < all.size(); ++i)
            v[i] = as_float(*all[i]);
        run_->keep(p.site.id, std::span(v.data(), all.size()));
    }

    /// The vectors of what was found, and of one more, added up.
    template <class Payload> void add(Payload& sum, const std::optional<Payload>& more, Change change) {
        if constexpr (requires { sum.fields(); }) {
            const auto as_asked = [&](const Vec3& v) {
                return change == Change::units_added_up || change == Change::improving_units_added_up
                           ? vector(fp_.normalize(floats(v)))
                           : v;
            };
            const auto visit = [&]<class Field>(Field& field, const Field* other) {
                if constexpr (std::is_same_v<Field, Vec3>)
                    field = other == nullptr ? as_asked(field) : field + as_asked(*other);
            };
            std::apply(
                [&](auto&... field) {
                    if (more)
                        std::apply([&](const auto&... other) { (visit(field, &other), ...); }, more->fields());
                    else
                        (visit(field, static_cast<const std::remove_reference_t<decltype(field)>*>(nullptr)), ...);
                },
                sum.fields());
        }
    }

    template <class T> static auto parts(T& value) {
        if constexpr (requires { value.fields(); })
            return std::apply([](auto&... field) { return std::array{&field...}; }, value.fields());
        else
            return std::array<T*, 1>{&value};
    }
    template <class T> static void keep(Made& made, T& value) {
        made.kept_size = 0;
        for (const auto* part : parts(value))
            made.kept[made.kept_size++] = as_float(*part);
    }
    static float as_float(const Real& x) { return static_cast<float>(x); }
    static float as_float(Int i) { return static_cast<float>(static_cast<int>(i)); }
    static void set(Real& to, float x) { to = x; }
    static void set(Int& to, float x) { to = static_cast<int>(x); }

    template <class T> void spoil(const Made& made, T& value) {
        const auto all = parts(value);
        const Mistake& mistake = made.mistake;
        if (mistake.change > Change::spoiled)
            return; // of the operation at this site
        if (mistake.change == Change::by_formula || mistake.change == Change::spoiled) {
            std::array<float, 4> v{};
            for (std::size_t i = 0; i < all.size(); ++i)
                v[i] = as_float(*all[i]);
            ask(made, std::span(v.data(), all.size()));
            for (std::size_t i = 0; i < all.size(); ++i)
                set(*all[i], v[i]);
            return;
        }
        if (mistake.change == Change::swapped) {
            if constexpr (all.size() > 1)
                std::swap(*all[0], *all[1]);
        } else if (mistake.change >= Change::yz_swapped && mistake.change <= Change::rotated_back) {
            if constexpr (all.size() == 3)
                reorder(*all[0], *all[1], *all[2], mistake.change);
        } else if (mistake.change == Change::x_everywhere) {
            for (auto* part : all)
                *part = *all[0];
        } else if (mistake.source == 0 || made.kept_size > 0) {
            for (std::size_t i = 0; i < all.size(); ++i)
                if (mistake.part < 0 || mistake.part == static_cast<int>(i))
                    set(*all[i],
                        changed_value<A>(mistake.change, as_float(*all[i]), made.kept[made.kept_size > 1 ? i : 0]));
        }
    }
    bool known(At p, bool condition, Kind kind) {
        see(p, kind);
        return whole(change_at(p), condition);
    }
    bool whole(Change change, bool condition) {
        leave(change, condition);
        switch (change) {
        case Change::inverted:
            return !condition;
        case Change::always:
            return true;
        case Change::never:
            return false;
        default:
            return condition;
        }
    }
    template <bool all, std::size_t n> bool holds(At p, const OpenComparisons<Real, all, n>& condition) {
        see(p, Kind::condition, static_cast<int>(n));
        bool at_site = false, is_all = all;
        if (run_ && n <= CameBy::most_values) {
            std::array<float, n> left{};
            for (std::size_t i = 0; i < n; ++i)
                left[i] = as_float(condition.part[i].a);
            run_->keep(p.site.id, left);
        }
        if (is_untouched(p))
            return holds(condition);
        if (const Made* made = formula_at(p, Change::decided_by_formula)) {
            std::array<float, 1 + 2 * n> v{holds(condition) ? 1.0F : 0.0F};
            for (std::size_t i = 0; i < n; ++i) {
                v[1 + 2 * i] = as_float(condition.part[i].a);
                v[2 + 2 * i] = as_float(condition.part[i].b);
            }
            ask(*made, v);
            return v[0] != 0.0F;
        }
        for (const Made& made : std::span(made_.data(), count_))
            if (made.mistake.site == p.site.id && made.mistake.change > Change::found_by_formula) {
                at_site = true;
                is_all = is_all != (made.mistake.change == Change::and_is_or);
            }
        bool answer = is_all;
        for (std::size_t i = 0; i < n; ++i) {
            const bool part = at_site ? part_holds(p, condition.part[i], static_cast<int>(i), all)
                                      : changed_answer(condition.part[i], Change::none);
            answer = is_all ? answer && part : answer || part;
        }
        return at_site ? whole(change_of(p, -1), answer) : answer;
    }
    template <bool all, std::size_t n> static bool holds(const OpenComparisons<Real, all, n>& condition) {
        bool answer = all;
        for (const OpenComparison<Real>& part : condition)
            answer = all ? answer && changed_answer(part, Change::none) : answer || changed_answer(part, Change::none);
        return answer;
    }
    [[nodiscard]] Change change_of(At p, int part) const {
        for (const Made& made : std::span(made_.data(), count_))
            if (made.mistake.site == p.site.id && made.mistake.part == part)
                return made.mistake.change;
        return Change::none;
    }
    bool part_holds(At p, const OpenComparison<Real>& c, int part, bool all) {
        const Change change = change_of(p, part);
        const bool answer = change == Change::dropped ? all : changed_answer(c, change);
        leave(change, answer);
        return answer;
    }
    static constexpr glm::vec4 zero{0.0F}, zero_but_alpha{0.0F, 0.0F, 0.0F, 1.0F};

    A fp_;
    std::array<Made, 8> made_;
    std::size_t count_ = 0;
    std::uint64_t touched_ = 0;
    bool looks_ = false;
    static constexpr int never_left = std::numeric_limits<int>::max();
    int loops_begun_ = 0, loops_open_ = 0;
    int left_from_ = never_left;   ///< this loop and those in it end with this turn
    std::optional<CameBy> run_;    ///< where a formula asks for it
    std::optional<CameBy> chosen_; ///< that, when what is chosen so far was offered
    std::vector<SeenSite> sites_;
};

} // namespace lockstep
