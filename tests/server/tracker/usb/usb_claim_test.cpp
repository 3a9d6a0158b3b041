#include "server/tracker/usb_claim.h"

#include <gtest/gtest.h>

#include <libusb.h>
#include <filesystem>

#include "server/tracker/liberty_models.h"

namespace posed::tracker {
namespace {

constexpr UsbIdentity kWho{0x0f44, 0xff20, 1, 4};

TEST(UsbErrors, EachNamesTheDeviceAndACure) {
  for (const int code : {LIBUSB_ERROR_ACCESS, LIBUSB_ERROR_BUSY, LIBUSB_ERROR_NO_DEVICE, LIBUSB_ERROR_IO}) {
    const Error error = usb_open_error(code, kWho);
    EXPECT_EQ(error.code, "not_available");
    EXPECT_NE(error.message.find("0f44:ff20 (/dev/bus/usb/001/004)"), std::string::npos) << error.message;
    EXPECT_FALSE(error.hint.empty());
  }
  EXPECT_NE(usb_open_error(LIBUSB_ERROR_ACCESS, kWho).hint.find("deploy/60-posed-trackers.rules"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(POSED_SOURCE_DIR "/deploy/60-posed-trackers.rules")) << "the cure names it";
}

TEST(UsbErrors, TheHolderIsUnknownWhereNobodyHoldsIt) {
  EXPECT_EQ(usb_holder({0x0f44, 0xff20, 250, 250}), "");
}

TEST(LibertyModels, LoadersAreNoTrackers) {
  for (const LibertyModel& model : liberty_models()) {
    EXPECT_EQ(liberty_by_product(model.product), &model);
    EXPECT_EQ(liberty_by_loader(model.loader_product), &model);
    EXPECT_EQ(liberty_by_product(model.loader_product), nullptr);
    EXPECT_NE(firmware_advice(model, kWho).find(model.loader_image), std::string::npos);
  }
}

}  // namespace
}  // namespace posed::tracker
