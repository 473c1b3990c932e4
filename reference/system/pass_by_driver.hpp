#pragma once
#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "reference/system/item_pass.hpp"

namespace lockstep {

/// A pass that rests on what a driver does where GL leaves it open: of several twins the one that a profile takes. All
/// make the same buffer of one stage.
class PassByProfile : public ItemPass {
  public:
    [[nodiscard]] std::string_view name() const override { return any().name(); }
    [[nodiscard]] std::uint8_t resource() const override { return any().resource(); }
    [[nodiscard]] PassStage stage() const override { return any().stage(); }
    [[nodiscard]] bool runs(int frame) const override { return any().runs(frame); }
    [[nodiscard]] bool continues() const override { return any().continues(); }
    [[nodiscard]] bool derived() const override { return any().derived(); }
    [[nodiscard]] bool in_place(const PassInput& in) const override { return any().in_place(in); }
    [[nodiscard]] std::optional<ItemRange> appended(const PassInput& in) const override { return any().appended(in); }
    [[nodiscard]] bool unordered() const override { return any().unordered(); }
    [[nodiscard]] std::string_view output(const Resource& about, std::uint8_t field) const override {
        return any().output(about, field);
    }
    void run(const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
             const WritableView& after) const override {
        on(profile).run(in, profile, first, last, after);
    }
    bool run_all(const PassInput& in, const Profile& profile, const WritableView& after) const override {
        return on(profile).run_all(in, profile, after);
    }
    [[nodiscard]] std::unique_ptr<ItemPass> prepared(const PassInput& in, const Profile& profile) const override {
        return on(profile).prepared(in, profile);
    }
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& profile,
                                                    const KnownOperations& known, const View* observed) const override {
        return on(profile).outcomes(in, item, profile, known, observed);
    }
    [[nodiscard]] std::vector<RecordedRow> record(const PassInput& in, std::size_t item,
                                                  const Profile& profile) const override {
        return on(profile).record(in, item, profile);
    }
    [[nodiscard]] FollowedStep follow(const PassInput& in, std::size_t item, const Profile& profile,
                                      const KnownOperations& known, std::span<const ToldValue> told) const override {
        return on(profile).follow(in, item, profile, known, told);
    }
    [[nodiscard]] std::vector<SeenSite> sites(const PassInput& in, std::size_t item,
                                              const Profile& profile) const override {
        return on(profile).sites(in, item, profile);
    }
    [[nodiscard]] std::vector<std::uint32_t> mistaken(const PassInput& in, std::size_t item, const Profile& profile,
                                                      std::span<const Mistake> made) const override {
        return on(profile).mistaken(in, item, profile, made);
    }

  protected:
    [[nodiscard]] virtual const ItemPass& on(const Profile& profile) const = 0;
    [[nodiscard]] virtual const ItemPass& any() const = 0; ///< of them, whatever the profile
};

/// One twin where the probe's row was followed, and another, of which more is legal, where it was not
/// (Profile::not_followed).
class PassByDriver final : public PassByProfile {
  public:
    PassByDriver(std::string row, std::shared_ptr<const ItemPass> followed, std::shared_ptr<const ItemPass> open)
        : row_(std::move(row)), followed_(std::move(followed)), open_(std::move(open)) {}

  private:
    [[nodiscard]] const ItemPass& on(const Profile& profile) const override {
        return profile.follows(row_) ? *followed_ : *open_;
    }
    [[nodiscard]] const ItemPass& any() const override { return *followed_; }

    std::string row_;
    std::shared_ptr<const ItemPass> followed_, open_;
};

/// A twin for each set of rules that profiles come to, made when one first does.
template <class Rules> class PassByRules final : public PassByProfile {
  public:
    PassByRules(std::function<Rules(const Profile&)> rules_of,
                std::function<std::unique_ptr<ItemPass>(const Rules&)> made)
        : rules_of_(std::move(rules_of)), made_(std::move(made)), any_(&with(Rules())) {}

  private:
    [[nodiscard]] const ItemPass& on(const Profile& profile) const override { return with(rules_of_(profile)); }
    [[nodiscard]] const ItemPass& any() const override { return *any_; }

    [[nodiscard]] const ItemPass& with(const Rules& rules) const {
        const std::scoped_lock lock(mutex_);
        const auto found = std::ranges::find(twins_, rules, &std::pair<Rules, std::unique_ptr<ItemPass>>::first);
        return found != twins_.end() ? *found->second : *twins_.emplace_back(rules, made_(rules)).second;
    }

    std::function<Rules(const Profile&)> rules_of_;
    std::function<std::unique_ptr<ItemPass>(const Rules&)> made_;
    mutable std::mutex mutex_;
    mutable std::vector<std::pair<Rules, std::unique_ptr<ItemPass>>> twins_;
    const ItemPass* any_;
};

} // namespace lockstep
