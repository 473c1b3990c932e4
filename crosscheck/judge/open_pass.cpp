#include "crosscheck/judge/open_pass.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/system/pass_by_driver.hpp"

namespace lockstep {
namespace {

bool meet(const Interval& x, const Interval& y) {
    if (x.any || y.any)
        return true;
    if (std::isnan(x.low) || std::isnan(y.low))
        return std::isnan(x.low) && std::isnan(y.low);
    return x.low <= y.high && y.low <= x.high;
}

/// Whether some values are of both.
bool meet(const ItemOutcome& a, const ItemOutcome& b) {
    return std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
                      [](const Interval& x, const Interval& y) { return meet(x, y); });
}

bool meet(const std::vector<ItemOutcome>& some, const std::vector<ItemOutcome>& others) {
    return std::any_of(some.begin(), some.end(), [&](const ItemOutcome& a) {
        return std::any_of(others.begin(), others.end(), [&](const ItemOutcome& b) { return meet(a, b); });
    });
}

/// The same where what a text leaves open need only meet what is nearby: one that says `precise` has the bits that it
/// asks for.
bool meet_nearby(const std::vector<ItemOutcome>& own, const std::vector<ItemOutcome>& others,
                 const std::vector<ItemOutcome>& nearby) {
    const auto fits = [](const ItemOutcome& a, const ItemOutcome& b, const ItemOutcome& near) {
        for (std::size_t c = 0; c < a.values.size(); ++c)
            if (!meet(a.values[c], b.values[c]) && (a.values[c].is_point() || !meet(a.values[c], near.values[c])))
                return false;
        return true;
    };
    for (const ItemOutcome& a : own)
        for (const ItemOutcome& b : others)
            if (std::any_of(nearby.begin(), nearby.end(), [&](const ItemOutcome& near) { return fits(a, b, near); }))
                return true;
    return false;
}

/// What is known of a text's outcomes: of more ways than are followed nothing is, so they open nothing.
std::vector<ItemOutcome> decided(std::vector<ItemOutcome> outcomes) {
    std::erase_if(outcomes, [](const ItemOutcome& one) { return one.undefined == Undefined::undecided; });
    return outcomes;
}

/// A reference rounds, too: another formula of the same numbers comes near where its terms are taken as freely.
KnownOperations in_any_order(KnownOperations known) {
    known.sums = false;
    return known;
}

/// Where some components of the reference have no legal way to them, the others keep theirs: what differs there is not
/// what is wrong.
void open_what_meets(const std::vector<ItemOutcome>& own, std::vector<ItemOutcome>& all) {
    for (ItemOutcome& one : all)
        for (std::size_t c = 0; c < one.values.size(); ++c)
            for (const ItemOutcome& a : own)
                if (a.undefined == Undefined::none && !a.values[c].any && !one.values[c].any &&
                    meet(a.values[c], one.values[c]) && !std::isnan(one.values[c].low))
                    one.values[c] = interval::hull(one.values[c], a.values[c]);
}

class OpenPass final : public PassByProfile {
  public:
    OpenPass(std::shared_ptr<const ItemPass> one, std::shared_ptr<const OwnText> own)
        : one_(std::move(one)), own_(std::move(own)) {}

    [[nodiscard]] std::span<const std::uint8_t> keeps() const override { return one_->keeps(); }
    [[nodiscard]] std::unique_ptr<ItemPass> prepared(const PassInput& in, const Profile& profile) const override {
        std::shared_ptr<const ItemPass> one = one_->prepared(in, profile);
        std::shared_ptr<const OwnText> own = own_->prepared(in, profile);
        if (!one && !own)
            return nullptr;
        return std::make_unique<OpenPass>(one ? one : one_, own ? own : own_);
    }
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& profile,
                                                    const KnownOperations& known, const View* observed) const override {
        std::vector<ItemOutcome> all = one_->outcomes(in, item, profile, known, observed);
        if (observed != nullptr &&
            std::any_of(all.begin(), all.end(), [&](const ItemOutcome& one) { return one.contains(*observed, item); }))
            return all;
        const std::vector<ItemOutcome> own = decided(own_->outcomes(in, item, profile, known));
        if (own.empty())
            return all;
        const auto is_near = [&] {
            const std::vector<ItemOutcome> written = decided(own_->outcomes_as_written(in, item, profile, known));
            const std::vector<ItemOutcome> nearby = one_->outcomes(in, item, profile, in_any_order(known), nullptr);
            return meet_nearby(own, all, nearby) || meet_nearby(written, all, nearby);
        };
        if (meet(own, all) || is_near())
            all.insert(all.end(), own.begin(), own.end());
        else
            open_what_meets(own, all);
        return all;
    }

  private:
    [[nodiscard]] const ItemPass& on(const Profile& /*profile*/) const override { return *one_; }
    [[nodiscard]] const ItemPass& any() const override { return *one_; }

    std::shared_ptr<const ItemPass> one_;
    std::shared_ptr<const OwnText> own_;
};

} // namespace

std::unique_ptr<ItemPass> open_pass(std::unique_ptr<ItemPass> reference, std::shared_ptr<const OwnText> own) {
    return std::make_unique<OpenPass>(std::move(reference), std::move(own));
}

} // namespace lockstep
