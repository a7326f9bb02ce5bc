#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <pcl_conversions/pcl_conversions.h>

#include <cmath>
#include <limits>

#include "sensor_msgs/point_cloud2_iterator.h"

namespace ros_shim::test {
namespace {

TEST(CvBridge, GoesThereAndBackWithoutLoss) {
  cv::Mat depth(3, 5, CV_32FC1);
  for (int i = 0; i < 15; ++i) depth.at<float>(i / 5, i % 5) = 0.25F * static_cast<float>(i);
  depth.at<float>(1, 1) = std::numeric_limits<float>::infinity();
  std_msgs::Header header;
  header.frame_id = "camera";
  const sensor_msgs::ImagePtr message =
      cv_bridge::CvImage(header, sensor_msgs::image_encodings::TYPE_32FC1, depth).toImageMsg();
  EXPECT_EQ(message->step, 20U);
  EXPECT_EQ(message->data.size(), 60U);
  const cv_bridge::CvImagePtr copy = cv_bridge::toCvCopy(message, message->encoding);
  EXPECT_EQ(copy->header.frame_id, "camera");
  EXPECT_EQ(cv::norm(copy->image.row(0), depth.row(0), cv::NORM_INF), 0.0);
  EXPECT_TRUE(std::isinf(copy->image.at<float>(1, 1)));
  const cv_bridge::CvImageConstPtr shared = cv_bridge::toCvShare(message);
  EXPECT_EQ(shared->image.data, message->data.data());
  EXPECT_NE(copy->image.data, message->data.data());
}

TEST(CvBridge, ConvertsEncodings) {
  cv::Mat mm(1, 2, CV_16UC1);
  mm.at<std::uint16_t>(0, 0) = 1500;
  mm.at<std::uint16_t>(0, 1) = 0;
  const sensor_msgs::ImageConstPtr message =
      cv_bridge::CvImage(std_msgs::Header(), "16UC1", mm).toImageMsg();
  EXPECT_EQ(cv_bridge::toCvCopy(message, "32FC1")->image.at<float>(0, 0), 1500.0F);
  cv::Mat rgb(1, 1, CV_8UC3, cv::Scalar(10, 20, 30));
  const sensor_msgs::ImageConstPtr picture =
      cv_bridge::CvImage(std_msgs::Header(), "rgb8", rgb).toImageMsg();
  EXPECT_EQ(cv_bridge::toCvCopy(picture, "bgr8")->image.at<cv::Vec3b>(0, 0), cv::Vec3b(30, 20, 10));
  EXPECT_EQ(cv_bridge::toCvCopy(picture, "mono8")->image.channels(), 1);
  EXPECT_THROW(cv_bridge::toCvCopy(picture, "16UC1"), cv_bridge::Exception);
  EXPECT_THROW(cv_bridge::toCvCopy(picture, "of a kind"), cv_bridge::Exception);
}

TEST(CvBridge, RefusesImagesWithTooFewPixels) {
  sensor_msgs::Image message;
  message.width = message.height = 4;
  message.encoding = "mono8";
  message.step = 4;
  message.data.resize(15);
  EXPECT_THROW(cv_bridge::toCvCopy(message), cv_bridge::Exception);
}

TEST(PclConversions, GoThereAndBack) {
  pcl::PointCloud<pcl::PointXYZI> cloud;
  cloud.push_back(pcl::PointXYZI(1.0F, 2.0F, 3.0F, 4.0F));
  cloud.push_back(pcl::PointXYZI(-1.0F, -2.0F, -3.0F, -4.0F));
  cloud.header.frame_id = "world";
  cloud.header.stamp = 1500000;
  sensor_msgs::PointCloud2 message;
  pcl::toROSMsg(cloud, message);
  EXPECT_EQ(message.header.stamp, ros::Time(1.5));
  pcl::PointCloud<pcl::PointXYZI> back;
  pcl::fromROSMsg(message, back);
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[1].z, -3.0F);
  EXPECT_EQ(back[1].intensity, -4.0F);
  EXPECT_EQ(back.header.frame_id, "world");
  pcl::PointCloud<pcl::PointXYZ> without;
  pcl::fromROSMsg(message, without);
  EXPECT_EQ(without[0].y, 2.0F);
}

TEST(PointCloud2Iterator, WritesAndReadsFields) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(3);
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"), z(cloud, "z");
  for (int i = 0; i < 3; ++i, ++x, ++z) {
    *x = static_cast<float>(i);
    *z = 10.0F * static_cast<float>(i);
  }
  int count = 0;
  for (sensor_msgs::PointCloud2ConstIterator<float> read(cloud, "z"); read != read.end(); ++read) {
    EXPECT_EQ(*read, 10.0F * static_cast<float>(count++));
  }
  EXPECT_EQ(count, 3);
  EXPECT_THROW(sensor_msgs::PointCloud2Iterator<float>(cloud, "w"), std::runtime_error);
}

}  // namespace
}  // namespace ros_shim::test
