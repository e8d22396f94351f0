/// The energy ledger as columns of the history.
#pragma once

#include "core/measure/measurement.hpp"

namespace grainbench {

class EnergyColumns : public Measurement {
public:
    void name_columns(std::vector<HistoryColumn>& columns) const override;
    void append_row(const MeasureView& view, std::vector<double>& row) const override;
};

}  // namespace grainbench
