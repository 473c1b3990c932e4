#include "crosscheck/package/divergent_pass.hpp"

#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/item_sample.hpp"

namespace lockstep {

DivergentPass::DivergentPass(const System& system, SystemSide& side, const KnownOperations& known,
                             const CheckReport& report)
    : system_(system), side_(side), known_(known) {
    if (report.verdict != Verdict::divergent || !report.verdicts || !report.verdicts->first)
        return;
    pass_ = report.verdicts->first->pass;
    frame_ = report.verdicts->first->place.frame;
}

JudgedPass DivergentPass::judged() {
    if (!run_)
        run_.emplace(system_, side_, known_, frame_, pass_.value());
    return run_->judged();
}

const DivergentPass::Items& DivergentPass::items() {
    if (items_)
        return *items_;
    const JudgedPass judged = this->judged();
    constexpr std::size_t most = 10, most_judged = 60;
    std::vector<std::size_t> different, alike, wrong;
    const std::uint8_t r = judged.pass.resource();
    for (std::size_t item = 0; item < judged.gpu.count(); ++item) {
        const auto gpu = item_words(judged.gpu, item);
        if (gpu != item_words(judged.reference, item))
            different.push_back(item);
        else if (gpu != item_words(judged.before[r], item))
            alike.push_back(item);
    }
    // What is legal follows from no line of the text alone.
    for (const std::size_t item : sample(different, most_judged))
        if (judge_item(judged, item).kind == DifferenceClass::divergent)
            wrong.push_back(item);
    items_ = {sample(wrong, most), sample(alike, most)};
    return *items_;
}

} // namespace lockstep
