/// NumPy's .npy files of structured arrays, a field of numbers for each column. Not installed.
///
///     points = np.rec.fromarrays([t, p, u, q], names="theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg")
///     np.save("points.npy", points)
///
/// Source: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html, versions 1 to 3.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hts::spectral {

class LineSource;

/// Reads row by row, so that a file may be of any length. Fields are float64, float32, int64 or int32, little
/// endian.
class NpyReader {
  public:
    /// hts::Error "path: …" if it is no such file.
    explicit NpyReader(const std::string& path);

    [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
    /// The bytes of the next row, false at the end; hts::Error if the file ends before its last row.
    bool take(std::string& bytes);
    /// The numbers in them.
    void numbers(std::string_view bytes, std::vector<double>& values) const;

  private:
    struct Field {
        char kind;  ///< f or i
        std::size_t begin, size;
    };
    void read_header(const std::string& header);
    void add_field(const std::string& name, const std::string& type);

    std::string path_;
    std::shared_ptr<LineSource> source_;
    std::vector<std::string> columns_;
    std::vector<Field> fields_;
    std::size_t row_size_ = 0, rows_ = 0, taken_ = 0;
};

/// What stands before the rows of a file of float64 columns; of the same length for any number of rows.
[[nodiscard]] std::string npy_header(const std::vector<std::string>& columns, std::size_t rows);

}  // namespace hts::spectral
