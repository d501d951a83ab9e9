// Ends TBB's workers before the program ends: the leak sanitizer of clang 14 crashes when, at exit, it looks into a
// thread that is ending too.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace {

class EndWorkers : public testing::Environment {
 public:
  void TearDown() override { EXPECT_TRUE(tbb::finalize(handle_, std::nothrow)) << "somebody still works"; }

 private:
  tbb::task_scheduler_handle handle_{tbb::attach{}};
};

const testing::Environment* const k_end_workers = testing::AddGlobalTestEnvironment(new EndWorkers);

}  // namespace
