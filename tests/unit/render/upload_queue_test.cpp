#include "globe/render/upload_queue.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

namespace globe::render {
namespace {

using clipmap::NodeRect;

/// A clock that only uploads move: so many milliseconds for each byte.
struct Uploader {
  double now = 0;
  double ms_a_byte = 1e-6;
  std::vector<UploadJob> pieces;

  UploadQueue::Clock clock() {
    return [this] { return now; };
  }
  std::function<void(const UploadJob&)> perform() {
    return [this](const UploadJob& job) {
      pieces.push_back(job);
      now += ms_a_byte * static_cast<double>(job.bytes());
    };
  }
};

UploadJob vertices(int layer, const NodeRect& nodes) {
  return {UploadJob::Kind::kVertices, layer, nodes, 32, nullptr, nullptr, 0};
}

TEST(UploadQueue, EveryTexelGoesOnceHoweverShortTheFrames) {
  std::mt19937 random(4);
  Uploader uploader;
  UploadQueue queue(uploader.clock());
  std::map<std::array<int, 3>, int> wanted, sent;
  for (int layer = 0; layer < 20; ++layer) {
    const NodeRect nodes{static_cast<int>(random() % 50), 50 + static_cast<int>(random() % 200),
                         static_cast<int>(random() % 50), 50 + static_cast<int>(random() % 100)};
    queue.add(vertices(layer, nodes));
    for (int j = nodes.j0; j <= nodes.j1; ++j) {
      for (int i = nodes.i0; i <= nodes.i1; ++i) wanted[{layer, i, j}] = 1;
    }
  }
  for (int frame = 0; !queue.empty(); ++frame) {
    ASSERT_LT(frame, 100000);
    uploader.ms_a_byte = 1e-6 * static_cast<double>(1 + random() % 5);
    const std::size_t before = queue.bytes();
    const std::size_t done = queue.run(0.01 * static_cast<double>(random() % 30), uploader.perform());
    EXPECT_GT(done, 0u) << "a frame without progress";
    EXPECT_EQ(queue.bytes(), before - done);
  }
  int layer = 0;
  for (const UploadJob& piece : uploader.pieces) {
    EXPECT_GE(piece.layer, layer) << "out of order";
    layer = piece.layer;
    for (int j = piece.nodes.j0; j <= piece.nodes.j1; ++j) {
      for (int i = piece.nodes.i0; i <= piece.nodes.i1; ++i) ++sent[{piece.layer, i, j}];
    }
  }
  EXPECT_EQ(sent, wanted);
  EXPECT_EQ(queue.bytes(), 0u);
}

TEST(UploadQueue, AFrameKeepsToItsTimeWithinOnePiece) {
  Uploader uploader;
  UploadQueue queue(uploader.clock());
  for (int layer = 0; layer < 50; ++layer) queue.add(vertices(layer, {0, 146, 0, 146}));
  for (int frame = 0; !queue.empty(); ++frame) {
    const double begin = uploader.now;
    queue.run(0.5, uploader.perform());
    if (frame > 20) {  // the pace is known by then
      EXPECT_LE(uploader.now - begin, 0.5 + 1e-9);
      if (!queue.empty()) {
        EXPECT_GE(uploader.now - begin, 0.4) << "time was left over";
      }
    }
    if (frame == 30) uploader.ms_a_byte *= 1.05;
  }
}

TEST(UploadQueue, NoTimeAtAllIsOneSmallPiece) {
  Uploader uploader;
  UploadQueue queue(uploader.clock());
  queue.add(vertices(0, {0, 146, 0, 146}));
  queue.run(0.0, uploader.perform());
  ASSERT_EQ(uploader.pieces.size(), 1u);
  EXPECT_LE(uploader.pieces.front().bytes(), UploadQueue::kSmallestBytes);
  EXPECT_GT(uploader.pieces.front().bytes(), UploadQueue::kSmallestBytes / 4);
}

TEST(UploadQueue, AllTheTimeIsEveryJobInOnePiece) {
  Uploader uploader;
  UploadQueue queue(uploader.clock());
  for (int layer = 0; layer < 5; ++layer) queue.add(vertices(layer, {0, 146, 0, 146}));
  queue.run(std::numeric_limits<double>::infinity(), uploader.perform());
  EXPECT_EQ(uploader.pieces.size(), 5u);
  EXPECT_TRUE(queue.empty());
}

TEST(UploadQueue, ASingleRowIsCutAcross) {
  Uploader uploader;
  UploadQueue queue(uploader.clock());
  queue.add(vertices(0, {0, 9999, 7, 7}));
  queue.run(0.0, uploader.perform());
  EXPECT_LE(uploader.pieces.front().bytes(), UploadQueue::kSmallestBytes);
  EXPECT_EQ(uploader.pieces.front().nodes.j0, 7);
}

}  // namespace
}  // namespace globe::render
