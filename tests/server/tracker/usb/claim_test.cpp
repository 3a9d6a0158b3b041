#include "server/tracker/usb/claim.h"

#include <gtest/gtest.h>

#include <libusb.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "server/tracker/usb/models.h"

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

TEST(UsbModels, LoadersAreNoTrackers) {
  for (const UsbModel& model : usb_models()) {
    EXPECT_EQ(usb_model_by_product(model.product), &model);
    EXPECT_EQ(usb_model_by_product(model.loader_product), nullptr);
    if (model.loader_product == 0) continue;
    EXPECT_EQ(usb_model_by_loader(model.loader_product), &model);
    EXPECT_NE(firmware_advice(model, kWho).find(model.loader_image), std::string::npos);
  }
}

// Whoever may not open a tracker gets told to install the rules, so they must hold every identity.
TEST(UsbModels, TheRulesHoldEveryIdentity) {
  std::ifstream file(POSED_SOURCE_DIR "/deploy/60-posed-trackers.rules");
  const std::string rules{std::istreambuf_iterator<char>(file), {}};
  for (const UsbModel& model : usb_models()) {
    for (const std::uint16_t product : {model.product, model.loader_product}) {
      if (product == 0) continue;
      char rule[80];
      std::snprintf(rule, sizeof rule, "\nATTR{idProduct}==\"%04x\", MODE=\"0660\"", product);
      EXPECT_NE(rules.find(rule), std::string::npos) << rule;
    }
    EXPECT_TRUE(model.loader_product == 0 || rules.find(model.loader_image) != std::string::npos) << model.name;
  }
}

}  // namespace
}  // namespace posed::tracker
