// finding_text.h — Findings in words, the same in every output.
#pragma once

#include <cstdint>
#include <string>

#include "gate/outputs.h"

namespace scene_analyzer::gate {

// "chair.glb: Leg (and 3 more)"; for people, one line, control characters replaced. Needs a
// report::UnicodeScope, as the next two do.
std::string place_of(const Finding& finding);
// "triangles 51200, limit max 20000 (2.56 times); the baseline has 41000"
std::string excess_of(const Finding& finding);
// place, excess and what to do.
std::string sentence(const Finding& finding);
// "3 times: it has no ... (first chair.glb: Leg)"
std::string sentence(const Reason& reason);

// One line of any text: well-formed UTF-8 without controls. Needs a report::UnicodeScope.
std::string clean(const std::string& text);

std::uint64_t count_failures(const CheckReport& report);  // assets that could not be analysed

}  // namespace scene_analyzer::gate
