#include "reference/system/stored_pass.hpp"

#include <cstring>
#include <utility>

#include "reference/stored_half.hpp"
#include "reference/system/pass_by_driver.hpp"

namespace lockstep {
namespace {

using Shared = std::shared_ptr<const ItemPass>;

Shared not_owned(const ItemPass& pass) { return {std::shared_ptr<const ItemPass>(), &pass}; }

class HalfPass final : public PassByProfile {
  public:
    explicit HalfPass(Shared made) : made_(std::move(made)) {}

    void run(const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
             const WritableView& after) const override {
        made_->run(in, profile, first, last, after);
        store(profile, first, last, after);
    }
    bool run_all(const PassInput& in, const Profile& profile, const WritableView& after) const override {
        if (!made_->run_all(in, profile, after))
            return false;
        store(profile, 0, after.count(), after);
        return true;
    }
    [[nodiscard]] std::unique_ptr<ItemPass> prepared(const PassInput& in, const Profile& profile) const override {
        Shared one = made_->prepared(in, profile);
        return one ? std::make_unique<HalfPass>(std::move(one)) : nullptr;
    }
    /// A value observed is a half: where the twin may make it, storing leaves it; where not, the twin ignores it.
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& profile,
                                                    const KnownOperations& known, const View* observed) const override {
        std::vector<ItemOutcome> all = made_->outcomes(in, item, profile, known, observed);
        for (ItemOutcome& outcome : all)
            for (Interval& value : outcome.values)
                value = stored_half(value, how(profile));
        return all;
    }
    [[nodiscard]] FollowedStep follow(const PassInput& in, std::size_t item, const Profile& profile,
                                      const KnownOperations& known, std::span<const ToldValue> told) const override {
        std::vector<ToldValue> on_the_way(told.begin(), told.end());
        std::erase_if(on_the_way, [&](const ToldValue& value) {
            return value.output == made_->output(in.before[resource()].about(), 0);
        });
        return made_->follow(in, item, profile, known, on_the_way);
    }
    [[nodiscard]] std::vector<std::uint32_t> mistaken(const PassInput& in, std::size_t item, const Profile& profile,
                                                      std::span<const Mistake> made) const override {
        std::vector<std::uint32_t> words = made_->mistaken(in, item, profile, made);
        for (std::uint32_t& word : words)
            word = stored(word, how(profile));
        return words;
    }

  private:
    [[nodiscard]] const ItemPass& on(const Profile& /*profile*/) const override { return *made_; }
    [[nodiscard]] const ItemPass& any() const override { return *made_; }

    [[nodiscard]] HalfStore how(const Profile& profile) const {
        return measured_of(profile, stage() == PassStage::compute ? stored_half_rows : drawn_half_rows);
    }

    static std::uint32_t stored(std::uint32_t word, HalfStore how) {
        return std::bit_cast<std::uint32_t>(stored_half(std::bit_cast<float>(word), how));
    }

    void store(const Profile& profile, std::size_t first, std::size_t last, const WritableView& after) const {
        if (after.columns[0] == nullptr)
            return;
        const HalfStore by = how(profile);
        const auto components = static_cast<std::size_t>(after.fields()[0].components);
        for (std::size_t w = first * components; w < last * components; ++w) {
            std::byte* place = after.columns[0] + w * sizeof(std::uint32_t);
            std::uint32_t word = 0;
            std::memcpy(&word, place, sizeof word);
            word = stored(word, by);
            std::memcpy(place, &word, sizeof word);
        }
    }

    Shared made_;
};

} // namespace

std::shared_ptr<const ItemPass> stored_pass(const ItemPass& made, const Schema& schema) {
    const Resource& about = schema.resources[made.resource()];
    const bool of_halves = about.dimensions > 1 && about.format.ends_with("16f");
    return of_halves && !made.unordered() ? std::make_shared<HalfPass>(not_owned(made)) : not_owned(made);
}

std::vector<std::shared_ptr<const ItemPass>> stored_passes(const std::vector<std::unique_ptr<ItemPass>>& made,
                                                           const Schema& schema) {
    std::vector<std::shared_ptr<const ItemPass>> all;
    for (const auto& pass : made)
        all.push_back(pass != nullptr && pass->resource() < schema.resources.size() ? stored_pass(*pass, schema)
                                                                                    : nullptr);
    return all;
}

} // namespace lockstep
