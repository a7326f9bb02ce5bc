#include <gtest/gtest.h>

#include "custom_metrics/computed_metrics.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

using namespace sample_rows;
using test::has;

class QueryMetrics : public testing::Test {
 protected:
  QueryMetrics() {
    db_.add_trial(finished());
    db_.add_trial(collided());
  }

  std::string message_of(const std::string& sql, double limit_s) {
    return test::message_of([&] { query_metrics(db_, sql, limit_s); });
  }

  TemporaryFolder folder_;
  Database db_ = begun(folder_ / "s.db");
};

TEST_F(QueryMetrics, AreTheColumnsOfTheSelect) {
  const ComputedMetrics computed = query_metrics(
      db_,
      "-- late_s: End [s]; less is better\nSELECT trial_key, end_time_s AS late_s FROM trials");
  ASSERT_EQ(computed.metrics.size(), 1U);
  EXPECT_EQ(computed.metrics[0].unit, "s");
  EXPECT_EQ(computed.metrics[0].better, Better::less);
  EXPECT_EQ(computed.values.at(collided().key), std::vector<double>{13.5});
}

TEST_F(QueryMetrics, OnlyLinesOfCommentsDescribe) {
  const ComputedMetrics computed =
      query_metrics(db_,
                    "-- of mine\n/*\n   late_s: not this [m]\n: */\n"
                    "-- late_s: End [s]\n"
                    "SELECT trial_key, end_time_s AS late_s FROM trials");
  ASSERT_EQ(computed.metrics.size(), 1U);
  EXPECT_EQ(computed.metrics[0].unit, "s");
}

TEST_F(QueryMetrics, ASelectWithoutAnEndIsEnded) {
  const std::string numbers = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) ";
  for (const char* select : {"SELECT trial_key, (SELECT max(i) FROM n) AS most FROM trials",
                             "SELECT trial_key, 1 AS one FROM trials, n"}) {
    const std::string message = message_of(numbers + select, 0.2);
    EXPECT_TRUE(has(message, "did not finish within 0.2 s")) << message;
  }
  // The database is as good as before, and without a deadline.
  EXPECT_EQ(db_.list_trials().size(), 2U);
}

TEST_F(QueryMetrics, MoreKeysThanTrialsAreRefused) {
  // Without an end, too, and all of them kept.
  const std::string message = message_of(
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) "
      "SELECT 'key' || i AS trial_key, i AS one FROM n",
      30.0);
  EXPECT_TRUE(has(message, "more trial_keys than there are trials")) << message;
}

}  // namespace
}  // namespace avoidbench
