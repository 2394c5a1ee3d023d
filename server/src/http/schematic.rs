//! Small flat trees that show what parameters do.

use std::time::Duration;

use axum::{Json, extract::State, response::IntoResponse};
use espalier_proto::Reason;
use espalier_settings::ParameterValues;
use tokio::time::timeout;

use crate::pool::{Class, Person};

use super::{
    Shared,
    failure::{Body, Failure},
};

/// Whoever drags a widget has moved on by then.
const TIME_LIMIT: Duration = Duration::from_secs(2);

/// The tree that these parameters grow (`SC1`).
pub(super) async fn draw(
    State(shared): State<Shared>,
    Body(parameters): Body<ParameterValues>,
) -> Result<impl IntoResponse, Failure> {
    let drawn =
        shared.pool.run(Class::Drawing, Person::default(), move |_| espalier_session::schematic(&parameters));
    let sentence = "The server is busy growing trees; the schematic took too long.";
    let late = |_| Failure::new(Reason::Busy, sentence);
    let schematic = timeout(TIME_LIMIT, drawn).await.map_err(late)???;
    Ok(Json(schematic))
}
