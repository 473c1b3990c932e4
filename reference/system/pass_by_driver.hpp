#pragma once
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reference/system/item_pass.hpp"

namespace lockstep {

/// A pass that rests on what a driver does where GL leaves it open: one twin where the probe's row was followed, and
/// another, of which more is legal, where it was not (Profile::not_followed). Both make the same buffer of one stage.
class PassByDriver final : public ItemPass {
  public:
    PassByDriver(std::string row, std::shared_ptr<const ItemPass> followed, std::shared_ptr<const ItemPass> open)
        : row_(std::move(row)), followed_(std::move(followed)), open_(std::move(open)) {}

    [[nodiscard]] std::string_view name() const override { return followed_->name(); }
    [[nodiscard]] std::uint8_t resource() const override { return followed_->resource(); }
    [[nodiscard]] PassStage stage() const override { return followed_->stage(); }
    [[nodiscard]] bool runs(int frame) const override { return followed_->runs(frame); }
    [[nodiscard]] bool continues() const override { return followed_->continues(); }
    [[nodiscard]] bool derived() const override { return followed_->derived(); }
    [[nodiscard]] bool in_place() const override { return followed_->in_place(); }
    [[nodiscard]] std::optional<ItemRange> appended(const PassInput& in) const override {
        return followed_->appended(in);
    }
    [[nodiscard]] bool unordered() const override { return followed_->unordered(); }
    [[nodiscard]] std::string_view output(const Resource& about, std::uint8_t field) const override {
        return followed_->output(about, field);
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

  private:
    [[nodiscard]] const ItemPass& on(const Profile& profile) const {
        return std::ranges::find(profile.not_followed, row_) == profile.not_followed.end() ? *followed_ : *open_;
    }

    std::string row_;
    std::shared_ptr<const ItemPass> followed_, open_;
};

} // namespace lockstep
