#include "tests/support/usb_usbfs.h"

#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

namespace posed::test {
namespace {

usbdevfs_urb& urb_of(UMockdevIoctlData* data) {
  return *reinterpret_cast<usbdevfs_urb*>(data->data);
}

}  // namespace

Usbfs::~Usbfs() {
  for (Urb& urb : flying_) release(urb);
  for (Urb& urb : done_) release(urb);
  if (node_ >= 0) ::close(node_);
}

// A regular file as node would always be ready, and libusb would spin. A FIFO that is kept full is not writable, and is
// emptied when there is something to reap.
void Usbfs::open_node(const std::string& path) {
  const std::lock_guard lock(mutex_);
  if (node_ >= 0) ::close(node_);
  for (std::size_t at = path.find('/', 1); at != std::string::npos; at = path.find('/', at + 1)) {
    ::mkdir(path.substr(0, at).c_str(), 0755);
  }
  ::mkfifo(path.c_str(), 0644);
  node_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ringing_ = true;
  ring();
}

void Usbfs::ring() {
  const bool wanted = !done_.empty() || gone_;
  char page[4096] = {};
  if (wanted && !ringing_) {
    while (::read(node_, page, sizeof page) > 0) continue;
  } else if (!wanted && ringing_) {
    while (::write(node_, page, sizeof page) > 0) continue;
  }
  ringing_ = wanted;
}

gboolean Usbfs::handle(UMockdevIoctlClient* client) {
  UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
  const std::lock_guard lock(mutex_);
  const gulong request = umockdev_ioctl_client_get_request(client);
  if (gone_ && request != USBDEVFS_REAPURB && request != USBDEVFS_REAPURBNDELAY && request != USBDEVFS_DISCARDURB) {
    umockdev_ioctl_client_complete(client, -1, ENODEV);
    return TRUE;
  }
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES: {
      UMockdevIoctlData* value = umockdev_ioctl_data_resolve(argument, 0, sizeof(guint32), nullptr);
      const guint32 capabilities = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                   USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_BULK_SCATTER_GATHER |
                                   USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      std::memcpy(value->data, &capabilities, sizeof capabilities);
      g_object_unref(value);
      umockdev_ioctl_client_complete(client, 0, 0);
      return TRUE;
    }
    case USBDEVFS_CLAIMINTERFACE:
    case USBDEVFS_DISCONNECT_CLAIM:
      claim(client);
      return TRUE;
    case USBDEVFS_RELEASEINTERFACE:
      if (owner_ == client) owner_ = nullptr;
      umockdev_ioctl_client_complete(client, 0, 0);
      return TRUE;
    case USBDEVFS_SETCONFIGURATION:
    case USBDEVFS_CLEAR_HALT:
    case USBDEVFS_RESET:
      umockdev_ioctl_client_complete(client, 0, 0);
      return TRUE;
    case USBDEVFS_IOCTL:      // re-attach a kernel driver
    case USBDEVFS_GETDRIVER:  // there is none
      umockdev_ioctl_client_complete(client, -1, ENODATA);
      return TRUE;
    case USBDEVFS_SUBMITURB:
      submit(client, argument);
      return TRUE;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      reap(client, argument);
      return TRUE;
    case USBDEVFS_DISCARDURB:
      discard(client, argument);
      return TRUE;
    default:
      return FALSE;
  }
}

void Usbfs::claim(UMockdevIoctlClient* client) {
  int error = owner_ && owner_ != client ? EBUSY : 0;
  if (claim_error_ != 0 && claim_failures_ != 0) {
    error = claim_error_;
    if (claim_failures_ > 0) --claim_failures_;
  }
  if (error == 0) {
    owner_ = client;
    ++claims_;
  }
  umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
}

void Usbfs::submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
  Urb urb{};
  urb.client = client;
  std::memcpy(&urb.address, argument->data, sizeof urb.address);  // before resolve puts our own there
  urb.data = umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr);
  usbdevfs_urb& fields = urb_of(urb.data);
  if (fields.buffer_length > 0) {
    urb.buffer = umockdev_ioctl_data_resolve(urb.data, offsetof(usbdevfs_urb, buffer),
                                             static_cast<gsize>(fields.buffer_length), nullptr);
  }
  flying_.push_back(urb);
  const auto flown = std::prev(flying_.end());
  if (fields.type == USBDEVFS_URB_TYPE_CONTROL) {
    finish(flown, -EPIPE, 0);
  } else if (!(fields.endpoint & 0x80)) {
    const std::uint8_t* bytes = urb.buffer ? urb.buffer->data : nullptr;
    const std::vector<std::uint8_t> copy(bytes, bytes + fields.buffer_length);
    const std::uint8_t endpoint = fields.endpoint;
    finish(flown, 0, fields.buffer_length);
    if (written_) written_(endpoint, copy);
  } else {
    match();
  }
  umockdev_ioctl_client_complete(client, 0, 0);
}

void Usbfs::reap(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
  const auto mine = std::find_if(done_.begin(), done_.end(), [&](const Urb& urb) { return urb.client == client; });
  if (mine == done_.end()) {
    umockdev_ioctl_client_complete(client, -1, gone_ ? ENODEV : EAGAIN);
    return;
  }
  UMockdevIoctlData* pointer = umockdev_ioctl_data_resolve(argument, 0, sizeof(gpointer), nullptr);
  umockdev_ioctl_data_set_ptr(pointer, 0, mine->data);
  g_object_unref(pointer);
  release(*mine);
  done_.erase(mine);
  ring();
  umockdev_ioctl_client_complete(client, 0, 0);
}

void Usbfs::discard(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
  gulong address = 0;
  std::memcpy(&address, argument->data, sizeof address);
  const auto found = std::find_if(flying_.begin(), flying_.end(),
                                  [&](const Urb& urb) { return urb.client == client && urb.address == address; });
  if (found == flying_.end()) {
    umockdev_ioctl_client_complete(client, -1, gone_ ? ENODEV : EINVAL);
    return;
  }
  finish(found, -ENOENT, 0);
  umockdev_ioctl_client_complete(client, 0, 0);
}

void Usbfs::vanish(UMockdevIoctlClient* client) {
  const std::lock_guard lock(mutex_);
  if (owner_ == client) owner_ = nullptr;
  for (std::list<Urb>* list : {&flying_, &done_}) {
    for (auto urb = list->begin(); urb != list->end();) {
      if (urb->client != client) {
        ++urb;
        continue;
      }
      release(*urb);
      urb = list->erase(urb);
    }
  }
  ring();
}

void Usbfs::finish(std::list<Urb>::iterator urb, int status, int length) {
  urb_of(urb->data).status = status;
  urb_of(urb->data).actual_length = length;
  done_.splice(done_.end(), flying_, urb);
  ring();
}

void Usbfs::release(Urb& urb) {
  if (urb.buffer) g_object_unref(urb.buffer);
  g_object_unref(urb.data);
}

}  // namespace posed::test
