#pragma once
#include <string>

#include "crosscheck/command/verb.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/legal.hpp"

namespace lockstep {

void add_legal_option(Verb& verb, Legal& legal);

/// --allow-undefined, --require-hits and --power-at-least.
void add_pass_options(Verb& verb, PassRules& rules);

/// --cover-at-least.
void add_cover_option(Verb& verb, PassRules& rules);

/// --werror-shaders: shader_warnings_are_errors(), of the whole process.
void add_werror_option(Verb& verb);
/// " --werror-shaders" where it was given.
std::string werror_option_text();

} // namespace lockstep
