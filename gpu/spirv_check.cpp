#include "gpu/spirv_check.hpp"

#include <algorithm>
#include <memory>

#include <spirv-tools/libspirv.h>

namespace lockstep {

std::string spirv_fault(std::span<const std::uint32_t> words) {
    const std::unique_ptr<spv_context_t, void (*)(spv_context)> context(spvContextCreate(SPV_ENV_UNIVERSAL_1_6),
                                                                        spvContextDestroy);
    const std::unique_ptr<spv_validator_options_t, void (*)(spv_validator_options)> options(spvValidatorOptionsCreate(),
                                                                                            spvValidatorOptionsDestroy);
    spvValidatorOptionsSetSkipBlockLayout(options.get(), true); // offsets are read as they are
    spv_const_binary_t module{words.data(), words.size()};
    spv_diagnostic found = nullptr;
    const spv_result_t result = spvValidateWithOptions(context.get(), options.get(), &module, &found);
    const std::unique_ptr<spv_diagnostic_t, void (*)(spv_diagnostic)> diagnostic(found, spvDiagnosticDestroy);
    if (result == SPV_SUCCESS)
        return "";
    std::string text = diagnostic != nullptr && diagnostic->error != nullptr ? diagnostic->error : "";
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? "SPIRV-Tools refuses it" : text;
}

} // namespace lockstep
