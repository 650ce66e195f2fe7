// acus as it is built where there is no VRPN.
#include "acus/haptics/backends.h"
#include "acus/haptics/vrpn_device.h"
#include "serving.h"

namespace acus::haptics {
namespace {

TEST(VrpnAbsent, is_one_sentence_that_says_how_to_get_it) {
  const Result<OpenDevice> device = open_device("vrpn:Phantom0@localhost");
  ASSERT_FALSE(device.ok());
  EXPECT_EQ(device.error().sentence, vrpn_missing());
  expect_one_sentence_with(vrpn_missing(), "acus was built without VRPN; install vrpn");
}

}  // namespace
}  // namespace acus::haptics
