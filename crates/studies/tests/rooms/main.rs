//! Rooms, proxies, cubemaps, and what is measured of whole materials.

mod cubemap;
mod patches;
mod proxies;
mod rooms;
mod surface_report;
mod surface_tables;
