#include "spectral/materials/coated_constants.hpp"

#include <utility>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_json.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

/// Checks thicknesses and number, whatever the wavelength.
void require_stack(const std::vector<FilmConstants>& films) {
    std::vector<Film> plain;
    plain.reserve(films.size());
    for (const FilmConstants& film : films) plain.push_back({{1, 0}, film.thickness});
    static_cast<void>(CoatedIndex{{1, 0}, plain, Wavelength::from_micrometres(1)});
}

FilmConstants film_from(const JsonValue& film, const std::filesystem::path& folder) {
    film.require_keys_among({"index", "thickness_um"});
    FilmConstants result{optical_constants_from(film["index"], folder), film["thickness_um"].number()};
    located(film["thickness_um"].place(), [&] { require_stack({result}); });
    return result;
}

}  // namespace

CoatedConstants::CoatedConstants(OpticalConstants substrate, std::vector<FilmConstants> films)
    : substrate_{std::move(substrate)}, films_{std::move(films)} {
    require_stack(films_);
}

std::string CoatedConstants::name() const {
    std::string text = substrate_.name();
    for (std::size_t i = 0; i < films_.size(); ++i) {
        text += (i == 0 ? " under " : ", ") + films_[i].constants.name() + " " +
                shortest(films_[i].thickness) + " um";
    }
    return text;
}

std::vector<std::string> CoatedConstants::warnings() const {
    std::vector<std::string> all = substrate_.warnings();
    for (const FilmConstants& film : films_)
        all.insert(all.end(), film.constants.warnings().begin(), film.constants.warnings().end());
    return all;
}

CoatedIndex CoatedConstants::index(const Wavelength& wavelength, OutsideRange policy) const {
    return on(substrate_.index(wavelength, policy), wavelength, policy);
}

CoatedIndex CoatedConstants::on(const RefractiveIndex& substrate, const Wavelength& wavelength,
                                OutsideRange policy) const {
    std::vector<Film> films;
    films.reserve(films_.size());
    for (const FilmConstants& film : films_) {
        if (film.thickness == 0) continue;
        films.push_back({film.constants.index(wavelength, policy), film.thickness});
    }
    return {substrate, films, wavelength};
}

CoatedConstants coated_constants_from(const JsonValue& material, const std::filesystem::path& folder) {
    OpticalConstants substrate = optical_constants_from(material["index"], folder);
    const auto list = material.find("films");
    if (!list) return substrate;
    std::vector<FilmConstants> films;
    for (const JsonValue& film : list->items()) films.push_back(film_from(film, folder));
    return located(list->place(), [&] { return CoatedConstants{std::move(substrate), std::move(films)}; });
}

}  // namespace hts::spectral
