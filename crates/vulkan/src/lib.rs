//! Machine code of compute shaders: a Vulkan driver compiles them and says what it made, by the
//! extension `VK_KHR_pipeline_executable_properties` or, where it lacks that, on the standard
//! streams. Nothing is submitted, so a driver that has no GPU will do.
//!
//! Every unsafe call of the workspace stands here. A driver can still end the process: run it in
//! one of its own.

mod error;

pub use error::VulkanError;

use std::collections::BTreeMap;
use std::ffi::{CStr, c_char};

use ash::khr::pipeline_executable_properties as executables;
use ash::vk;
use error::named;

/// What a shader may bind, in set 0, by binding: what it is given, two outputs, a texture, its
/// sampler, and two blocks of uniforms.
pub const BINDINGS: [vk::DescriptorType; 7] = [
    vk::DescriptorType::STORAGE_BUFFER,
    vk::DescriptorType::STORAGE_BUFFER,
    vk::DescriptorType::STORAGE_BUFFER,
    vk::DescriptorType::SAMPLED_IMAGE,
    vk::DescriptorType::SAMPLER,
    vk::DescriptorType::UNIFORM_BUFFER,
    vk::DescriptorType::UNIFORM_BUFFER,
];

/// A device that compiles.
pub struct Compiler {
    device: ash::Device,
    /// None of a driver that lacks the extension.
    executables: Option<executables::Device>,
    layout: vk::PipelineLayout,
    /// The device, as the driver names it.
    pub name: String,
    /// The driver's version: `22.3.6`.
    pub version: String,
    /// Whether shaders may compute in f16, and read and write it in buffers.
    pub half: bool,
    /// Last, for the device goes before its instance, and the instance before the library.
    instance: ash::Instance,
    _library: ash::Entry,
}

/// A compiled shader.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Compiled {
    /// What the driver counted, by the names that it gives.
    pub statistics: BTreeMap<String, i64>,
    /// The machine code as text.
    pub assembly: String,
}

impl Compiler {
    /// The first device whose driver's name or whose own name holds a word: `radv`. A driver
    /// `states` what it compiles by the extension, or prints it.
    ///
    /// # Errors
    /// No loader, no such device, a driver that does not state what it compiles and should.
    pub fn open(word: &str, states: bool) -> Result<Compiler, VulkanError> {
        // SAFETY: the library is the system's Vulkan loader, and outlives all that is made by it.
        let library = unsafe { ash::Entry::load() }
            .map_err(|reason| VulkanError::Loader { reason: reason.to_string() })?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_2);
        let create = vk::InstanceCreateInfo::default().application_info(&application);
        // SAFETY: the description is complete, and lives as long as the call.
        let instance = named("vkCreateInstance", unsafe { library.create_instance(&create, None) })?;
        // SAFETY: the instance is alive.
        let all = named("vkEnumeratePhysicalDevices", unsafe { instance.enumerate_physical_devices() })?;
        let mut found = Vec::new();
        for physical in all {
            let mut of = vk::PhysicalDeviceDriverProperties::default();
            let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut of);
            // SAFETY: the chain is of structures that Vulkan 1.2 knows.
            unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
            let properties = properties.properties;
            let names = [text(&of.driver_name), text(&properties.device_name)];
            if names.iter().any(|name| name.contains(word)) {
                let [_, name] = names;
                let version = version(properties.driver_version);
                return Compiler::of(library, instance, physical, [name, version], states);
            }
            found.push(names.join(" "));
        }
        Err(VulkanError::NoDevice { driver: word.into(), found })
    }

    fn of(
        library: ash::Entry,
        instance: ash::Instance,
        physical: vk::PhysicalDevice,
        [name, version]: [String; 2],
        states: bool,
    ) -> Result<Compiler, VulkanError> {
        let Features(mut statistics, mut small, mut stored) = Features::default();
        let mut features = vk::PhysicalDeviceFeatures2::default()
            .push_next(&mut statistics)
            .push_next(&mut small)
            .push_next(&mut stored);
        // SAFETY: the chain is of structures that Vulkan 1.2 and the extension know.
        unsafe { instance.get_physical_device_features2(physical, &mut features) };
        if states && statistics.pipeline_executable_info == vk::FALSE {
            let what = "VK_KHR_pipeline_executable_properties";
            return Err(VulkanError::Lacks { device: name, what });
        }
        let half = small.shader_float16 & stored.storage_buffer16_bit_access == vk::TRUE;
        // Of the features that the device has, these alone: some others change code.
        let Features(statistics, small, stored) = Features::default();
        let (mut statistics, mut small) =
            (statistics.pipeline_executable_info(true), small.shader_float16(true));
        let mut stored = stored.storage_buffer16_bit_access(true);
        let queue = [vk::DeviceQueueCreateInfo::default().queue_priorities(&[1.0])];
        let extensions = [executables::NAME.as_ptr()];
        let mut create = vk::DeviceCreateInfo::default().queue_create_infos(&queue);
        if half {
            create = create.push_next(&mut small).push_next(&mut stored);
        }
        if states {
            create = create.enabled_extension_names(&extensions).push_next(&mut statistics);
        }
        // SAFETY: the features asked for are those that the device has, as it just said.
        let device = named("vkCreateDevice", unsafe { instance.create_device(physical, &create, None) })?;
        let layout = layout(&device)?;
        let executables = states.then(|| executables::Device::new(&instance, &device));
        Ok(Compiler { device, executables, layout, name, version, half, instance, _library: library })
    }

    /// Compiles an entry point of a compute shader in SPIR-V that binds no more than [`BINDINGS`].
    /// The code must be valid: a driver may end the process where it is not. Nothing is known here of
    /// what a driver prints.
    ///
    /// # Errors
    /// What the driver refuses.
    pub fn compile(&self, spirv: &[u32], entry: &CStr) -> Result<Compiled, VulkanError> {
        let create = vk::ShaderModuleCreateInfo::default().code(spirv);
        // SAFETY: the caller says that the code is valid; the slice lives as long as the call.
        let module =
            named("vkCreateShaderModule", unsafe { self.device.create_shader_module(&create, None) })?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(entry);
        let mut create = vk::ComputePipelineCreateInfo::default().stage(stage).layout(self.layout);
        if self.executables.is_some() {
            create = create.flags(
                vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR
                    | vk::PipelineCreateFlags::CAPTURE_INTERNAL_REPRESENTATIONS_KHR,
            );
        }
        let cache = vk::PipelineCache::null();
        // SAFETY: module and layout are of this device and alive, and the feature is on.
        let made = unsafe { self.device.create_compute_pipelines(cache, &[create], None) };
        let made = named("vkCreateComputePipelines", made.map_err(|(_, result)| result));
        let compiled = made.and_then(|pipelines| {
            let compiled = self.compiled(pipelines[0]);
            // SAFETY: nothing else has the pipeline.
            unsafe { self.device.destroy_pipeline(pipelines[0], None) };
            compiled
        });
        // SAFETY: nothing else has the module.
        unsafe { self.device.destroy_shader_module(module, None) };
        compiled
    }

    /// What the driver says of a pipeline, whose one executable is that of the compute stage.
    fn compiled(&self, pipeline: vk::Pipeline) -> Result<Compiled, VulkanError> {
        let Some(executables) = &self.executables else { return Ok(Compiled::default()) };
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipeline);
        // SAFETY: the pipeline is alive, and was made to say this.
        let all = unsafe { executables.get_pipeline_executable_statistics(&info) };
        let all = named("vkGetPipelineExecutableStatisticsKHR", all)?;
        let statistics = all.iter().map(|one| (text(&one.name), value(one))).collect();
        let call = "vkGetPipelineExecutableInternalRepresentationsKHR";
        // SAFETY: as above; with no place for the data, their sizes are returned.
        let sized = unsafe { executables.get_pipeline_executable_internal_representations(&info) };
        let mut all = named(call, sized)?;
        let mut texts: Vec<Vec<u8>> = all.iter().map(|one| vec![0; one.data_size]).collect();
        for (one, text) in all.iter_mut().zip(&mut texts) {
            one.p_data = text.as_mut_ptr().cast();
        }
        let mut count = all.len() as u32;
        let get = executables.fp().get_pipeline_executable_internal_representations_khr;
        // SAFETY: each place is as large as the driver said, and lives as long as the call.
        let done = unsafe { get(self.device.handle(), &info, &mut count, all.as_mut_ptr()) };
        named(call, done.result())?;
        let assembly = all.iter().zip(&texts).find(|(one, _)| text(&one.name).contains("ssembly"));
        let Some((_, assembly)) = assembly else {
            return Err(VulkanError::Lacks { device: self.name.clone(), what: "assembly" });
        };
        let end = assembly.iter().position(|&byte| byte == 0).unwrap_or(assembly.len());
        Ok(Compiled { statistics, assembly: String::from_utf8_lossy(&assembly[..end]).into_owned() })
    }
}

/// Features that shaders and statistics take.
#[derive(Default)]
struct Features(
    vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR<'static>,
    vk::PhysicalDeviceShaderFloat16Int8Features<'static>,
    vk::PhysicalDevice16BitStorageFeatures<'static>,
);

impl Drop for Compiler {
    fn drop(&mut self) {
        // SAFETY: nothing of the device is in use, and its instance goes after it.
        unsafe {
            self.device.destroy_pipeline_layout(self.layout, None);
            self.device.destroy_device(None);
            self.instance.destroy_instance(None);
        }
    }
}

/// The layout of [`BINDINGS`].
fn layout(device: &ash::Device) -> Result<vk::PipelineLayout, VulkanError> {
    let bindings: Vec<_> = (0..)
        .zip(BINDINGS)
        .map(|(at, of)| {
            let binding = vk::DescriptorSetLayoutBinding::default().binding(at).descriptor_type(of);
            binding.descriptor_count(1).stage_flags(vk::ShaderStageFlags::COMPUTE)
        })
        .collect();
    let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
    // SAFETY: the bindings are distinct, and live as long as the call.
    let set = unsafe { device.create_descriptor_set_layout(&create, None) };
    let sets = [named("vkCreateDescriptorSetLayout", set)?];
    let create = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
    // SAFETY: the set's layout is of this device and alive.
    let layout = named("vkCreatePipelineLayout", unsafe { device.create_pipeline_layout(&create, None) });
    // SAFETY: a layout of pipelines does not need those of its sets once it is made.
    unsafe { device.destroy_descriptor_set_layout(sets[0], None) };
    layout
}

/// The value of a statistic; those that are no integers are rounded.
fn value(one: &vk::PipelineExecutableStatisticKHR<'_>) -> i64 {
    // SAFETY: the format says which member the driver wrote, and all of them are plain numbers.
    unsafe {
        match one.format {
            vk::PipelineExecutableStatisticFormatKHR::BOOL32 => i64::from(one.value.b32),
            vk::PipelineExecutableStatisticFormatKHR::FLOAT64 => one.value.f64.round() as i64,
            vk::PipelineExecutableStatisticFormatKHR::INT64 => one.value.i64,
            _ => one.value.u64 as i64,
        }
    }
}

/// A version as Mesa's drivers write it.
fn version(number: u32) -> String {
    [vk::api_version_major(number), vk::api_version_minor(number), vk::api_version_patch(number)]
        .map(|part| part.to_string())
        .join(".")
}

/// A name that ends with a zero, as structures of the API hold it.
fn text(name: &[c_char]) -> String {
    name.iter().take_while(|&&c| c != 0).map(|&c| char::from(c as u8)).collect()
}
