//! Files that become trees of the library, or versions of one.

use axum::{extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::{
    library::ImportNote,
    text::{Name, Note},
};
use espalier_session::announced_bytes;
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Shared,
    failure::{Failure, Path, Query},
    revision::Expected,
    trees,
    uploads::File,
    versions::{self, Said},
};
use crate::{
    access::Caller,
    import::{self, Import, Imported},
    import_options::{ImportOptions, InternodeLength, SpeciesName, Unit},
    memory::{self, Use},
    pool::Class,
    store::{Contents, NewVersion, Saved},
};

/// Declares what an address says of a file, beside fields of its own.
macro_rules! of_a_file {
    ($(#[doc = $doc:literal])+ $name:ident { $($(#[doc = $about:literal])+ $field:ident: $type:ty,)* }) => {
        $(#[doc = $doc])+
        #[derive(Debug, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        #[schemars(inline)]
        pub(super) struct $name {
            $($(#[doc = $about])+ $field: $type,)*
            /// How the name of such a file ends.
            format: import::Format,
            /// Metres in one unit of the file.
            unit: Option<Unit>,
            /// Metres in one unit of its diameters and radii, where that is another.
            diameter_unit: Option<Unit>,
            /// Metres in one internode.
            internode_length: Option<InternodeLength>,
            /// The short name of the species whose looks and growth it gets.
            species: Option<SpeciesName>,
        }

        impl $name {
            fn import(&self, metamers: u32) -> Import {
                let &Self { format, unit, diameter_unit, internode_length, species, .. } = self;
                let options = ImportOptions { unit, diameter_unit, internode_length, species };
                Import {
                    format,
                    units: options.units(),
                    seed: rand::random(),
                    species: options.species(),
                    parameters: vec![options.parameters()],
                    metamers,
                }
            }
        }
    };
}

of_a_file! {
    /// What the address says of a file that becomes a tree.
    Upload {
        /// The name of the tree.
        name: Name,
    }
}

of_a_file! {
    /// What the address says of a file that becomes a version of a tree.
    VersionUpload {
        /// What is said of the version: up to 2000 characters.
        note: Option<Note>,
        /// How whoever saves it wants to be called: 1 to 80 characters.
        author: Option<Name>,
    }
}

/// A file as a new tree (`IM1`).
pub(super) async fn upload(
    State(shared): State<Shared>,
    caller: Caller,
    Query(upload): Query<Upload>,
    file: File,
) -> Result<impl IntoResponse, Failure> {
    let import = upload.import(shared.metamer_budget);
    let said = Said::by(&caller, None, None);
    let (version, notes) = made(&shared, &caller, import, file, said).await?;
    Ok((StatusCode::CREATED, trees::add_noted(&shared, &caller, upload.name.into(), version, notes).await?))
}

/// A file as the newest version of a tree (`IM2`).
pub(super) async fn upload_version(
    State(shared): State<Shared>,
    caller: Caller,
    Path(tree): Path<String>,
    Expected(expected): Expected,
    Query(upload): Query<VersionUpload>,
    file: File,
) -> Result<impl IntoResponse, Failure> {
    trees::stored(&shared, &tree).await?;
    let import = upload.import(shared.metamer_budget);
    let said = Said::by(&caller, upload.author, upload.note);
    let (version, notes) = made(&shared, &caller, import, file, said).await?;
    versions::add_noted(&shared, &tree, expected, version, notes).await
}

/// What a file holds, as a version to be saved, and what is to be known of it (`IM3`).
async fn made(
    shared: &Shared,
    caller: &Caller,
    import: Import,
    File(file, turn): File,
    said: Said,
) -> Result<(NewVersion, Vec<ImportNote>), Failure> {
    // Few bytes may become many: what a document says that it unpacks to is taken before anything of it is.
    let unpacked = match import.format {
        import::Format::Document => memory::unpacked(announced_bytes(&file)),
        import::Format::Wood(_) => 0,
    };
    let claim = shared.memory.take_soon(Use::Upload, unpacked).await?;
    let made = shared.pool.run(Class::Whole, caller.person().into(), move |_| {
        let made = import::document(&file, &import).map_err(|error| import.refusal(&error)).map(
            |Imported { document, notes }| {
                let notes = notes.iter().map(import::ImportNote::to_proto).collect();
                (Saved::of(&document), notes)
            },
        );
        // Not before, whether or not anybody still waits: they are for the memory that this takes.
        drop((claim, turn));
        made
    });
    let (saved, notes) = made.await??;
    Ok((versions::new(caller, said, Contents::New(Box::new(saved))), notes))
}
