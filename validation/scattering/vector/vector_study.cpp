#include "validation/scattering/vector/vector_study.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <sstream>

#include "hts/error.hpp"
#include "spectral/text/unfinished.hpp"
#include "validation/scattering/gaussian_surface.hpp"
#include "validation/scattering/vector/conductor_patch.hpp"

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;
constexpr double period_over_length = 1.25;  // of the beam

/// A number for the surface, so that each has seeds of its own.
std::uint64_t surface_number(const VectorSurface& surface) {
    std::uint64_t number = 0;
    for (const double length : {surface.rms_roughness, surface.lengths.along, surface.lengths.across})
        number = 1000003 * number + static_cast<std::uint64_t>(std::lround(1e4 * length));
    return number;
}

/// All directions of the grid, both sides of the plane of incidence: azimuth steps go once round.
std::vector<Direction> directions(double forward) {
    std::vector<Direction> all;
    for (int i = 0; i < polar_steps; ++i) {
        for (int j = 0; j < 2 * azimuth_steps; ++j)
            all.push_back(Direction::from_angles(polar_angle(i), forward + azimuth(j)));
    }
    return all;
}

/// How the intensities and amplitudes of a beam's far fields count.
struct Share {
    float of_intensity, of_field;
};

/// Adds an amplitude's part in each channel of the incident state.
void add(Scatter& to, Incident state, const FarAmplitude& exact, const FarAmplitude& kirchhoff, Share share) {
    const std::size_t own = state == Incident::s ? 0 : 1;
    const auto into = [&](auto& intensities, auto& fields, const FarAmplitude& f) {
        intensities[own] += share.of_intensity * std::norm(f.s);      // ss or sp
        intensities[2 + own] += share.of_intensity * std::norm(f.p);  // ps or pp
        fields[own] += share.of_field * (own == 0 ? f.s : f.p);
    };
    into(to.exact, to.exact_field, exact);
    into(to.kirchhoff, to.kirchhoff_field, kirchhoff);
}

/// What a beam's far fields are on the grid.
void add(ScatterGrid& grid, Incident state, const std::vector<FarAmplitude>& exact,
         const std::vector<FarAmplitude>& kirchhoff, Share share) {
    constexpr std::size_t half = azimuth_steps, round = 2 * half;
    for (std::size_t at = 0; at < polar_steps * round; ++at) {
        const std::size_t i = at / round, j = at % round;
        const std::size_t folded = j < half ? j : round - 1 - j;
        add(grid[half * i + folded], state, exact[at], kirchhoff[at], share);
    }
}

constexpr std::size_t grid_size = std::size_t{polar_steps} * azimuth_steps;

std::size_t grid_count(const VectorSurface& surface, const VectorSettings& settings) {
    return settings.theta_i_deg.size() * (surface.isotropic() ? 1 : vector_azimuths_deg.size());
}

}  // namespace

Surface VectorSurface::surface() const {
    if (isotropic()) return Surface{rms_roughness, lengths.along};
    return Surface::anisotropic(rms_roughness, lengths, Direction::from_angles(pi / 2, 0));
}

double polar_angle(int step) noexcept {
    return (step + 0.5) * pi / 2 / polar_steps;
}

double azimuth(int step) noexcept {
    return (step + 0.5) * pi / azimuth_steps;
}

double solid_angle(int polar_step) noexcept {
    const double width = pi / 2 / polar_steps;
    return 2 * pi / azimuth_steps * (std::cos(polar_step * width) - std::cos((polar_step + 1) * width));
}

VectorRealisation realisation(const VectorSurface& surface, const VectorSettings& settings,
                              std::size_t number) {
    const double step = 1 / static_cast<double>(surface.points_per_wavelength);
    const auto side = static_cast<std::size_t>(std::lround(settings.length / step));
    const ConductorPatch patch{random_field(surface.rms_roughness, surface.lengths, step, side,
                                            seed_of(settings.study, surface_number(surface), number))};
    std::vector<PlaneWaveBeam> beams;
    std::vector<Currents> right;
    for (const double plane : vector_azimuths_deg) {
        for (const double theta : settings.theta_i_deg) {
            beams.emplace_back(theta * degree, plane * degree, settings.beam_width(),
                               period_over_length * settings.length);
            for (Currents& each : patch.kirchhoff(beams.back())) right.push_back(std::move(each));
        }
    }
    const SolvedCurrents exact = patch.solved(right, settings.tolerance);
    VectorRealisation result{std::vector<ScatterGrid>(grid_count(surface, settings), ScatterGrid(grid_size)),
                             0};
    // means over both sides of the plane of incidence, and over the planes of an isotropic surface
    const double samples = surface.isotropic() ? 2 * vector_azimuths_deg.size() : 2;
    const std::size_t in_plane = incident_states.size() * settings.theta_i_deg.size();
    for (std::size_t plane = 0; plane < vector_azimuths_deg.size(); ++plane) {
        std::vector<const Currents*> currents;
        for (const std::vector<Currents>& all : {std::cref(exact.of), std::cref(right)}) {
            for (std::size_t i = 0; i < in_plane; ++i) currents.push_back(&all[plane * in_plane + i]);
        }
        const auto far = patch.radiated(currents, directions(vector_azimuths_deg[plane] * degree));
        for (std::size_t i = 0; i < in_plane; ++i) {
            const std::size_t theta = i / incident_states.size();
            const std::size_t grid =
                surface.isotropic() ? theta : plane * settings.theta_i_deg.size() + theta;
            const double power = beams[plane * settings.theta_i_deg.size() + theta].power();
            add(result.grids[grid], incident_states[i % incident_states.size()], far[i], far[in_plane + i],
                {static_cast<float>(1 / (samples * power)),
                 static_cast<float>(1 / (samples * std::sqrt(power)))});
        }
    }
    for (const int iterations : exact.iterations)
        result.iterations += static_cast<float>(iterations) / static_cast<float>(exact.iterations.size());
    return result;
}

RealisationFile::RealisationFile(const std::filesystem::path& folder, const VectorSurface& surface,
                                 const VectorSettings& settings, std::size_t number)
    : grids_{grid_count(surface, settings)} {
    std::ostringstream name, head;
    name << surface.rms_roughness << '-' << surface.lengths.along << '-' << surface.lengths.across << '-'
         << number;
    path_ = folder / (name.str() + ".part");
    head << "hts vector scattering 1, surface and number " << name.str() << ", "
         << surface.points_per_wavelength << " points per wavelength, " << settings.length << " long, to "
         << settings.tolerance << ", seed " << settings.study << ", from";
    for (const double theta : settings.theta_i_deg) head << ' ' << theta;
    head << '\n';
    head_ = head.str();
}

bool RealisationFile::exists() const {
    return std::filesystem::exists(path_);
}

VectorRealisation RealisationFile::read() const {
    static_assert(std::endian::native == std::endian::little, "the files are of little-endian numbers");
    std::ifstream file{path_, std::ios::binary};
    const std::string bytes{std::istreambuf_iterator<char>{file}, {}};
    if (!bytes.starts_with(head_))
        throw Error{path_.string() + ": is of another run of this study (" +
                    bytes.substr(0, bytes.find('\n')) + "); must be removed first"};
    VectorRealisation result{std::vector<ScatterGrid>(grids_, ScatterGrid(grid_size)), 0};
    if (bytes.size() != head_.size() + grids_ * grid_size * sizeof(Scatter) + sizeof(float))
        throw Error{path_.string() + ": is damaged; must be removed first"};
    const char* from = bytes.data() + head_.size();
    for (ScatterGrid& grid : result.grids) {
        std::memcpy(grid.data(), from, grid_size * sizeof(Scatter));
        from += grid_size * sizeof(Scatter);
    }
    std::memcpy(&result.iterations, from, sizeof(float));
    return result;
}

void RealisationFile::write(const VectorRealisation& realisation) const {
    std::string bytes = head_;
    for (const ScatterGrid& grid : realisation.grids)
        bytes.append(reinterpret_cast<const char*>(grid.data()), grid.size() * sizeof(Scatter));
    bytes.append(reinterpret_cast<const char*>(&realisation.iterations), sizeof(float));
    // not by spectral::write_file, whose files appear when the program ends
    const std::filesystem::path begun = path_.string() + ".begun";
    const spectral::Unfinished unfinished{begun.string(), spectral::Unfinished::Kind::file};
    std::ofstream file{begun, std::ios::binary};
    file << bytes;
    if (!file.flush()) throw Error{path_.string() + ": cannot be written"};
    std::filesystem::rename(begun, path_);
}

}  // namespace hts::validation
