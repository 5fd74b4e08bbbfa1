/// From height maps of one surface to its statistics, spectra and descriptions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/topography/map_statistics.hpp"
#include "validation/topography/spectrum_fit.hpp"

namespace hts::validation {

struct SurfaceRequest {
    Levelling levelling;
    Window window = Window::hann;
    std::optional<FrequencyBand> band{};  ///< frequencies that are trusted; all that the maps have otherwise
};

/// One map, and what was found of it alone.
struct StudiedMap {
    LevelledMap levelled;
    double inflation;  ///< of its window
    MapSpectrum spectrum;
    Autocorrelation autocorrelation;
    HeightStatistics statistics;
    FrequencyBand known;
};

struct SurfaceStudy {
    SurfaceRequest request;
    std::vector<StudiedMap> maps;
    HeightStatistics statistics;      ///< of all maps
    std::vector<RadialBin> radial;    ///< of all maps, by directions that count alike
    Autocorrelation autocorrelation;  ///< mean of all maps, by the first one's distances
    Anisotropy anisotropy;
    Ellipse ellipse;      ///< that of the anisotropy where it is significant
    FrequencyBand known;  ///< of all maps together
    std::vector<SpectrumFit> fits;

    /// Of the heights over all frequencies, and over those of the spectra.
    [[nodiscard]] double rms_of_spectra() const;
};

/// The same bits for any number of threads.
[[nodiscard]] SurfaceStudy studied(std::vector<HeightMap> maps, const SurfaceRequest& request);

}  // namespace hts::validation
