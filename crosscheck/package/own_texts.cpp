#include "crosscheck/package/own_texts.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "crosscheck/package/driver_notes.hpp"
#include "crosscheck/text/text_pass.hpp"
#include "gpu/shader_use.hpp"
#include "lockstep/shader_text.hpp"
#include "reference/system/pass_by_driver.hpp"

namespace lockstep {
namespace {

/// Another's pass.
class PassBeside final : public PassByProfile {
  public:
    explicit PassBeside(const ItemPass& pass) : pass_(pass) {}
    [[nodiscard]] std::span<const std::uint8_t> keeps() const override { return pass_.keeps(); }

  private:
    [[nodiscard]] const ItemPass& on(const Profile& /*profile*/) const override { return pass_; }
    [[nodiscard]] const ItemPass& any() const override { return pass_; }

    const ItemPass& pass_;
};

} // namespace

System beside(const System& system) {
    System made{system.name, system.schema, {}, system.mistakes, system.start, system.settings};
    for (const std::unique_ptr<ItemPass>& pass : system.passes)
        made.passes.push_back(pass == nullptr ? nullptr : std::make_unique<PassBeside>(*pass));
    return made;
}

void SystemTexts::take_references(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& gpu,
                                  UnusedShaders unused) {
    const ShaderUse use = shader_use(of_.system.schema.system, stages_of(of_.passes, of_.arithmetic), folder);
    check_shader_use(use, folder, unused == UnusedShaders::allowed);
    check_references(use, folder, of_.passes);
    references_ = lockstep::take_references(of_, use, folder, gpu);
}

void SystemTexts::take_shaders(const std::filesystem::path& folder, const std::filesystem::path& reference) {
    own_ = {{}, shader_use(of_.system.schema.system, stages_of(of_.passes, of_.arithmetic), folder), folder, reference};
    own_->texts = open_by_own_text(of_, own_->use, folder);
    show_texts(of_, folder);
}

TextNotes SystemTexts::notes(SystemSide& side, const KnownOperations& known, CheckReport& report,
                             CoveredRuns covered) const {
    TextNotes notes{.lines = references_.lines, .findings = {}, .coverage = {}};
    if (own_) {
        DivergentPass divergence(of_.system, side, known, report);
        TextNotes of_own = text_notes(of_, *own_, divergence, report, covered);
        std::ranges::move(driver_notes(of_, own_->texts, own_->folder, of_own.findings, divergence),
                          std::back_inserter(notes.lines));
        std::ranges::move(of_own.lines, std::back_inserter(notes.lines));
        notes.coverage = std::move(of_own.coverage);
    }
    for (std::string& note : reference_notes(of_, references_.texts, side.describe().profile, report.frames))
        notes.lines.push_back(std::move(note));
    return notes;
}

std::vector<std::unique_ptr<ItemPass>> passes_by_text(const Schema& schema, const std::vector<GlPass>& passes,
                                                      const std::string& folder) {
    System system{.name = schema.system,
                  .schema = schema,
                  .passes = passes_without_twins(passes),
                  .mistakes = {},
                  .start = {},
                  .settings = {}};
    SystemTexts(system, passes).take_references(folder, std::nullopt);
    return std::move(system.passes);
}

} // namespace lockstep
