//! The choice of an adapter, and what is required of it.

use std::sync::{Arc, Mutex};

use super::{Gpu, Library};

/// Which adapters are wanted, and which of them first.
#[derive(Clone, Debug, Default)]
pub struct Preference {
    /// A part of the adapter's name, any case.
    pub name: Option<String>,
    /// The backend, if only one will do.
    pub backend: Option<wgpu::Backends>,
    /// Whether a software adapter comes before hardware: tests want the one that every machine has.
    pub software_first: bool,
    /// Features to do without even if the adapter has them: how tests see the fallbacks.
    pub masked_features: wgpu::Features,
}

/// Why there is no device.
#[derive(Debug, thiserror::Error)]
pub enum AdapterError {
    /// No adapter at all.
    #[error(
        "no usable graphics adapter was found; install a Vulkan driver (Debian: `apt install libvulkan1 mesa-vulkan-drivers`)"
    )]
    None,
    /// None of this name.
    #[error("no graphics adapter matches {wanted}: {found}")]
    NoMatch {
        /// The name and backend that were asked for.
        wanted: String,
        /// What was found, and what to do about it.
        found: String,
    },
    /// Adapters, but none that is able.
    #[error("no graphics adapter is able to run this: {0}")]
    Incapable(String),
    /// The driver refused a device.
    #[error("the driver of {adapter} refused a device: {reason}; try another with --adapter (`rilievo adapters` lists them)")]
    Device {
        /// The adapter.
        adapter: String,
        /// What the driver said.
        reason: String,
    },
}

/// What this program asks of every adapter: the baseline of WebGPU.
pub fn required_limits() -> wgpu::Limits {
    wgpu::Limits::default()
}

/// Features that make it faster or more talkative; each has a fallback.
pub const OPTIONAL_FEATURES: wgpu::Features = wgpu::Features::FLOAT32_FILTERABLE.union(wgpu::Features::TIMESTAMP_QUERY);

/// Adapter, backend and driver in one line.
pub fn describe(info: &wgpu::AdapterInfo) -> String {
    let driver =
        [info.driver.as_str(), info.driver_info.as_str()].iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>();
    let driver = if driver.is_empty() { "unnamed driver".to_owned() } else { driver.join(" ") };
    format!("{} ({}, {}, {driver})", info.name, info.backend, kind(info.device_type))
}

/// What kind of device it is, in a word.
pub fn kind(device_type: wgpu::DeviceType) -> &'static str {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "software",
        wgpu::DeviceType::Other => "other",
    }
}

impl Preference {
    /// Completes what the command line left open from `WGPU_BACKEND` and `WGPU_ADAPTER_NAME`.
    pub fn with_environment(mut self) -> Self {
        // A name that wgpu does not know is no choice.
        self.backend = self.backend.or_else(wgpu::Backends::from_env).filter(|backends| !backends.is_empty());
        self.name = self.name.or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok()).filter(|name| !name.is_empty());
        self
    }

    /// The backends to look at, in turn: OpenGL only if nothing else answers, for there most limits are lower.
    pub fn backend_sets(&self) -> Vec<wgpu::Backends> {
        match self.backend {
            Some(backends) => vec![backends],
            None => vec![wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12, wgpu::Backends::GL],
        }
    }

    /// Whether the adapter has the name that is wanted.
    pub fn allows(&self, info: &wgpu::AdapterInfo) -> bool {
        self.name.as_ref().is_none_or(|name| info.name.to_lowercase().contains(&name.to_lowercase()))
    }

    fn rank(&self, device_type: wgpu::DeviceType) -> u8 {
        let rank = match device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        };
        if self.software_first { 4 - rank } else { rank }
    }

    fn describe(&self) -> String {
        let name = self.name.as_ref().map(|name| format!("'{name}'"));
        let backend = self.backend.map(|backends| format!("backend {}", backend_names(backends)));
        [name, backend].into_iter().flatten().collect::<Vec<_>>().join(" and ")
    }
}

fn backend_names(backends: wgpu::Backends) -> String {
    backends.iter_names().map(|(name, _)| name.to_lowercase()).collect::<Vec<_>>().join("|")
}

/// An instance for the given backends, obeying wgpu's environment variables.
pub fn instance(backends: wgpu::Backends, display: Option<Box<dyn wgpu::wgt::WgpuHasDisplayHandle>>) -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    descriptor.backends = backends;
    // Validation layers are for those who ask (WGPU_VALIDATION=1, WGPU_DEBUG=1): where they are installed they cost seconds.
    descriptor.flags = wgpu::InstanceFlags::empty().with_env();
    descriptor.display = display;
    wgpu::Instance::new(descriptor)
}

/// Every adapter of the machine that the preferred backends reach, of any name, best first.
pub async fn enumerate(preference: &Preference) -> Vec<(wgpu::Instance, wgpu::Adapter)> {
    let mut found = Vec::new();
    for backends in preference.backend_sets() {
        let instance = instance(backends, None);
        let mut adapters = instance.enumerate_adapters(backends).await;
        adapters.sort_by_key(|adapter| preference.rank(adapter.get_info().device_type));
        found.extend(adapters.into_iter().map(|adapter| (instance.clone(), adapter)));
    }
    found
}

/// What the adapter lacks, in words; `None` if nothing.
pub fn shortcoming(adapter: &wgpu::Adapter) -> Option<String> {
    let (required, actual) = (required_limits(), adapter.limits());
    let mut lacks = Vec::new();
    required.check_limits_with_fail_fn(&actual, false, |name, required, actual| {
        lacks.push(format!("{name} is {actual} of {required} required"));
    });
    if !adapter.get_downlevel_capabilities().flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS) {
        lacks.push("compute shaders are missing".to_owned());
    }
    (!lacks.is_empty()).then(|| lacks.join(", "))
}

impl Gpu {
    /// Opens the best adapter that the preference allows, one that can draw to `surface` if there is one.
    ///
    /// # Errors
    ///
    /// There is no adapter, none matches, none is able, or its driver refuses a device: the error names what was required and
    /// what was found.
    pub async fn new(preference: &Preference) -> Result<Self, AdapterError> {
        let mut incapable = Vec::new();
        let mut others = Vec::new();
        for backends in preference.backend_sets() {
            let instance = instance(backends, None);
            match Self::choose(preference, instance, None, &mut incapable, &mut others).await {
                Some(gpu) => return gpu,
                None => continue,
            }
        }
        Err(nothing(preference, &incapable, &others))
    }

    /// Opens the best adapter that can draw to the window surface.
    ///
    /// # Errors
    ///
    /// As [`Gpu::new`].
    pub async fn for_surface(
        preference: &Preference,
        instance: wgpu::Instance,
        surface: &wgpu::Surface<'_>,
    ) -> Result<Self, AdapterError> {
        let (mut incapable, mut others) = (Vec::new(), Vec::new());
        match Self::choose(preference, instance, Some(surface), &mut incapable, &mut others).await {
            Some(gpu) => gpu,
            None => Err(nothing(preference, &incapable, &others)),
        }
    }

    async fn choose(
        preference: &Preference,
        instance: wgpu::Instance,
        surface: Option<&wgpu::Surface<'_>>,
        incapable: &mut Vec<String>,
        others: &mut Vec<String>,
    ) -> Option<Result<Self, AdapterError>> {
        let mut adapters = instance.enumerate_adapters(preference.backend.unwrap_or(wgpu::Backends::all())).await;
        // A stable sort: the platform's own order decides between equals.
        adapters.sort_by_key(|adapter| preference.rank(adapter.get_info().device_type));
        for adapter in adapters {
            let info = adapter.get_info();
            if !preference.allows(&info) {
                others.push(describe(&info));
                continue;
            }
            if surface.is_some_and(|surface| !adapter.is_surface_supported(surface)) {
                incapable.push(format!("{} cannot draw to the window", describe(&info)));
                continue;
            }
            if let Some(lacks) = shortcoming(&adapter) {
                incapable.push(format!("{}: {lacks}", describe(&info)));
                continue;
            }
            return Some(Self::open(preference, instance, adapter).await);
        }
        None
    }

    async fn open(preference: &Preference, instance: wgpu::Instance, adapter: wgpu::Adapter) -> Result<Self, AdapterError> {
        let actual = adapter.limits();
        // The baseline, but fields and pictures as large as the adapter can hold.
        let limits = wgpu::Limits {
            max_texture_dimension_2d: actual.max_texture_dimension_2d,
            max_buffer_size: actual.max_buffer_size,
            max_storage_buffer_binding_size: actual.max_storage_buffer_binding_size,
            ..required_limits()
        };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("rilievo"),
            required_features: OPTIONAL_FEATURES & adapter.features() & !preference.masked_features,
            required_limits: limits,
            ..Default::default()
        };
        let (device, queue) = adapter
            .request_device(&descriptor)
            .await
            .map_err(|error| AdapterError::Device { adapter: describe(&adapter.get_info()), reason: error.to_string() })?;
        let errors = Arc::new(Mutex::new(Vec::new()));
        let sink = errors.clone();
        // Without a handler wgpu panics. Modes ask for what was collected after each frame and end with one sentence.
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            // Modes tell it, once, as the sentence of an error.
            log::debug!("{error}");
            if let Ok(mut errors) = sink.lock() {
                errors.push(error.to_string());
            }
        }));
        log::info!("adapter: {}", describe(&adapter.get_info()));
        Ok(Self { instance, adapter, device, queue, shaders: Library::embedded(), errors })
    }
}

/// Why nothing was chosen, of adapters that are incapable and others that have another name.
pub fn nothing(preference: &Preference, incapable: &[String], others: &[String]) -> AdapterError {
    if !incapable.is_empty() {
        AdapterError::Incapable(incapable.join("; "))
    } else if preference.name.is_some() || preference.backend.is_some() {
        let found = match others {
            [] => "there is none at all by that way, try without it or install a driver".to_owned(),
            _ => format!("choose another, of {}", others.join("; ")),
        };
        AdapterError::NoMatch { wanted: preference.describe(), found }
    } else {
        AdapterError::None
    }
}
