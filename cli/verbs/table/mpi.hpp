/// Several processes at one table: MPI ranks where the program was built with -DHTS_MPI=ON and started by
/// mpirun, else one.
#pragma once

#include "tables/sharing/table_parts.hpp"

namespace hts::cli {

/// The ranks of this run. The first builds the table and hands slices to the others, which compute them in
/// their constructors and are done.
class Ranks {
  public:
    Ranks(const spectral::Reflectance& exact, const tables::TableJob& job);
    ~Ranks();  // NOLINT(performance-trivially-destructible): with MPI it does something
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    /// Whether this process is to build the table.
    [[nodiscard]] bool first() const noexcept { return first_; }
    [[nodiscard]] tables::SliceWorker worker();

  private:
    const spectral::Reflectance& exact_;
    [[maybe_unused]] const tables::TableJob& job_;
    bool first_ = true;
};

}  // namespace hts::cli
