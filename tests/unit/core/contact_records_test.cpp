/// What contacts leave behind, through changes of the population and checkpoints.
#include "core/contact/contact_records.hpp"

#include <gtest/gtest.h>

namespace grainbench {
namespace {

const Renumbered last_and_first{.touching_before = {2, 0}, .turned = {false, true}};

void leave_alone(double*) {}

TEST(ContactRecords, CarryEnergiesAloneOverToOtherNumbers) {
    ContactRecords records;
    records.prepare(Records::stored_energy, 3);
    EXPECT_EQ(records.rows_from(0), nullptr);
    for (const Index t : {0U, 1U, 2U}) {
        *records.stored_from(t) = 10.0 + t;
    }
    records.renumber(last_and_first, 3, leave_alone);
    EXPECT_EQ(records.stored(0), 12.0);
    EXPECT_EQ(records.stored(1), 10.0);
}

TEST(ContactRecords, TurnTheRecordsOfThoseThatChangePlaces) {
    ContactRecords records;
    records.prepare(Records::all, 3);
    EXPECT_EQ(records.stored_from(0), nullptr);
    for (const Index t : {0U, 1U, 2U}) {
        records.rows_from(t)[record_stored] = 10.0 + t;
        records.rows_from(t)[record_shear_x] = 1.0 + t;
    }
    records.renumber(
        last_and_first, 3, [](double* row) { row[record_shear_x] = -row[record_shear_x]; });
    EXPECT_TRUE(records.has_rows(2));
    EXPECT_EQ(records.stored(0), 12.0);
    EXPECT_EQ(records.row(0)[record_shear_x], 3.0);
    EXPECT_EQ(records.stored(1), 10.0);
    EXPECT_EQ(records.row(1)[record_shear_x], -1.0);
}

TEST(ContactRecords, AreInACheckpointAsFarAsAskedFor) {
    ContactRecords records;
    records.prepare(Records::stored_energy, 2);
    *records.stored_from(0) = 3.0;
    *records.stored_from(1) = 4.0;
    Archive archive;
    records.save(archive, "pairs", Records::stored_energy);
    ContactRecords again;
    again.load(archive, "pairs", Records::stored_energy, 2);
    EXPECT_EQ(again.stored(0), 3.0);
    EXPECT_EQ(again.stored(1), 4.0);
    EXPECT_THROW(again.load(archive, "pairs", Records::stored_energy, 3), Error);
}

}  // namespace
}  // namespace grainbench
