// signal.h — The signal behind the Fourier rating and its spectrum, as tables and as one picture.
//
// `area_scale` takes areas, and with them magnitudes, to the row's world units.
#pragma once

#include <span>
#include <string>

#include "analysis/analysis.h"
#include "analysis/signal.h"

namespace scene_analyzer::report {

// "index,area" and "k,magnitude" from 0 on, one line per value, printed so that reading them gives the same
// doubles.
std::string signal_csv(std::span<const double> areas, double area_scale);
std::string spectrum_csv(std::span<const double> magnitudes, double area_scale);

// An SVG of the signal above and of |X_1|..|X_c| below, with what `geometry` says about them; UTF-8,
// deterministic, at most about 110 kB whatever the length. `title`: any text.
std::string signal_svg(const analysis::SignalSpectrum& signal, const analysis::GeometryAnalysis& geometry,
                       double area_scale, const std::string& title);

}  // namespace scene_analyzer::report
