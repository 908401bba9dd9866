// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/graphics/pipeline_cost.hpp"

#include <array>
#include <string_view>

namespace carpus::bench {
namespace {

constexpr std::uint32_t kBindings = 16;
constexpr std::uint32_t kAttributes = 16;
constexpr VkFormat kColour = VK_FORMAT_R8G8B8A8_UNORM;

VkShaderModule module_of(VkDevice device, const std::vector<std::uint32_t>& code) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = code.size() * sizeof(std::uint32_t);
  info.pCode = code.data();
  VkShaderModule module = VK_NULL_HANDLE;
  demand(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
  return module;
}

VkPipelineLayout layout_of(VkDevice device) {
  std::array<VkDescriptorSetLayoutBinding, kBindings> bindings{};
  for (std::uint32_t i = 0; i < kBindings; ++i) {
    bindings[i] = {
        i, i == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
        1, VK_SHADER_STAGE_ALL_GRAPHICS, nullptr};
  }
  VkDescriptorSetLayoutCreateInfo set{};
  set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set.bindingCount = kBindings;
  set.pBindings = bindings.data();
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  demand(vkCreateDescriptorSetLayout(device, &set, nullptr, &set_layout),
         "vkCreateDescriptorSetLayout");
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  demand(vkCreatePipelineLayout(device, &info, nullptr, &layout), "vkCreatePipelineLayout");
  return layout;
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits of, VkShaderModule module) {
  VkPipelineShaderStageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = of;
  info.module = module;
  info.pName = "main";
  return info;
}

VkPipeline pipeline_of(VkDevice device,
                       const std::vector<std::uint32_t>& vertex,
                       const std::vector<std::uint32_t>& fragment) {
  const std::array stages = {stage(VK_SHADER_STAGE_VERTEX_BIT, module_of(device, vertex)),
                             stage(VK_SHADER_STAGE_FRAGMENT_BIT, module_of(device, fragment))};
  const VkVertexInputBindingDescription binding{0, 4 * sizeof(float), VK_VERTEX_INPUT_RATE_VERTEX};
  std::array<VkVertexInputAttributeDescription, kAttributes> attributes{};
  for (std::uint32_t i = 0; i < kAttributes; ++i)
    attributes[i] = {i, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0};
  VkPipelineVertexInputStateCreateInfo input{};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  input.vertexBindingDescriptionCount = 1;
  input.pVertexBindingDescriptions = &binding;
  input.vertexAttributeDescriptionCount = kAttributes;
  input.pVertexAttributeDescriptions = attributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  const VkViewport viewport{0, 0, 64, 64, 0, 1};
  const VkRect2D scissor{{0, 0}, {64, 64}};
  VkPipelineViewportStateCreateInfo view{};
  view.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  view.viewportCount = 1;
  view.pViewports = &viewport;
  view.scissorCount = 1;
  view.pScissors = &scissor;
  VkPipelineRasterizationStateCreateInfo raster{};
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{};
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineColorBlendAttachmentState attachment{};
  attachment.colorWriteMask = 0xF;
  VkPipelineColorBlendStateCreateInfo blend{};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = 1;
  blend.pAttachments = &attachment;
  VkPipelineRenderingCreateInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachmentFormats = &kColour;

  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = &rendering;
  info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &view;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pColorBlendState = &blend;
  info.layout = layout_of(device);
  VkPipeline pipeline = VK_NULL_HANDLE;
  demand(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
         "vkCreateGraphicsPipelines");
  return pipeline;
}

}  // namespace

std::vector<StageCost> pipeline_cost(const NullDevice& device,
                                     const std::vector<std::uint32_t>& vertex,
                                     const std::vector<std::uint32_t>& fragment) {
  const VkDevice handle = device.handle();
  const auto properties_of = reinterpret_cast<PFN_vkGetPipelineExecutablePropertiesKHR>(
      vkGetDeviceProcAddr(handle, "vkGetPipelineExecutablePropertiesKHR"));
  const auto statistics_of = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
      vkGetDeviceProcAddr(handle, "vkGetPipelineExecutableStatisticsKHR"));
  // What is made here ends with the program: one pair of shaders, one run.
  VkPipelineInfoKHR pipeline{};
  pipeline.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR;
  pipeline.pipeline = pipeline_of(handle, vertex, fragment);
  std::uint32_t count = 0;
  demand(properties_of(handle, &pipeline, &count, nullptr), "vkGetPipelineExecutablePropertiesKHR");
  VkPipelineExecutablePropertiesKHR blank{};
  blank.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR;
  std::vector<VkPipelineExecutablePropertiesKHR> stages(count, blank);
  demand(properties_of(handle, &pipeline, &count, stages.data()),
         "vkGetPipelineExecutablePropertiesKHR");

  std::vector<StageCost> costs;
  for (std::uint32_t i = 0; i < count; ++i) {
    VkPipelineExecutableInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
    info.pipeline = pipeline.pipeline;
    info.executableIndex = i;
    std::uint32_t told = 0;
    demand(statistics_of(handle, &info, &told, nullptr), "vkGetPipelineExecutableStatisticsKHR");
    VkPipelineExecutableStatisticKHR none{};
    none.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    std::vector<VkPipelineExecutableStatisticKHR> statistics(told, none);
    demand(statistics_of(handle, &info, &told, statistics.data()),
           "vkGetPipelineExecutableStatisticsKHR");
    StageCost cost;
    cost.stage = stages[i].name;
    cost.lanes = stages[i].subgroupSize;
    for (const auto& one : statistics) {
      const std::string_view name = one.name;
      if (name == "Inverse Throughput") cost.cycles = one.value.u64;
      if (name == "Instructions") cost.instructions = one.value.u64;
      if (name == "VGPRs") cost.registers = one.value.u64;
    }
    if (cost.cycles == 0 || cost.lanes == 0)
      throw std::runtime_error("this driver does not tell what a shader costs");
    costs.push_back(cost);
  }
  return costs;
}

}  // namespace carpus::bench
