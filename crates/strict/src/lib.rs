//! Files that a user brings, read strictly: text is bounded and looked at before a parser sees it, JSON
//! becomes typed values, and what is refused is refused with file, line, column and field.

mod error;
pub mod escape;
pub mod limits;
pub mod number;
mod object;
#[cfg(feature = "schema")]
mod schema;
mod text;
pub mod value;

pub use error::{Position, SceneError};
pub use object::{place, read_object};
pub use text::{accept, plain, refused};
