//! Predictions and the ghosts that answer them (`PD`).

use std::sync::{Arc, atomic::Ordering};

use espalier_proto::{GhostFrame, ServerMessage};

use super::Session;
use crate::{
    clients::PredictionView,
    io::{ClientId, Output},
    prediction::{Cancelled, Prediction, PredictionRun, Question},
    work::Work,
};

/// Predictions of one session that are made at a time: each has plants of its own.
const MAX_FORESEEING: usize = 2;

impl PredictionView {
    /// Cancels the prediction that was asked for last.
    pub(crate) fn cancel(&self) {
        if let Some(running) = &self.running {
            running.store(true, Ordering::Relaxed);
        }
    }

    /// Nothing is wanted, made or waits; a number for what comes next.
    fn start_over(&mut self) -> u32 {
        self.cancel();
        self.wanted = None;
        self.ready = None;
        self.number = self.number.wrapping_add(1);
        self.number
    }
}

impl Session {
    /// A client asks for a prediction; for none without rows and steps.
    pub(super) fn predict(&mut self, client: ClientId, prediction: Prediction) {
        if prediction.steps == 0 && prediction.rows.is_empty() {
            return self.end_prediction(client);
        }
        let Some(connected) = self.connected_mut(client) else { return };
        connected.prediction_view.start_over();
        connected.prediction_view.wanted = Some(prediction);
    }

    /// The client's ghost goes, and so does what would become one.
    pub(super) fn end_prediction(&mut self, client: ClientId) {
        let epoch = self.epoch;
        let Some(connected) = self.connected_mut(client) else { return };
        let sequence = connected.prediction_view.start_over();
        if connected.prediction_view.is_shown {
            connected.prediction_view.is_shown = false;
            let ended = GhostFrame { epoch, sequence, changes: Vec::new() };
            self.outputs.push_back(Output::Frame(client, ended.encode().into()));
        }
    }

    /// Gives questions to the document, which is about to go to the simulation pool.
    pub(super) fn ask_questions(&mut self, work: &mut Work) {
        for (&client, state) in &mut self.clients {
            let Some(connected) = &mut state.connected else { continue };
            let prediction_view = &mut connected.prediction_view;
            if self.predictions >= MAX_FORESEEING || prediction_view.running.is_some() {
                continue;
            }
            let Some(prediction) = prediction_view.wanted.take() else { continue };
            let cancelled = Cancelled::default();
            prediction_view.running = Some(Arc::clone(&cancelled));
            self.predictions += 1;
            work.questions.push(Question { client, number: prediction_view.number, prediction, cancelled });
        }
    }

    /// A prediction is done, or was given up.
    pub(super) fn finish_prediction(&mut self, prediction: PredictionRun) {
        self.predictions = self.predictions.saturating_sub(1);
        let PredictionRun { question, answer, .. } = prediction;
        let Some(connected) = self.connected_mut(question.client) else { return };
        connected.prediction_view.running = None;
        if question.number != connected.prediction_view.number {
            return;
        }
        match answer {
            Some(Ok(ghost)) => {
                connected.prediction_view.ready = Some(ghost);
                self.send_ghost(question.client);
            }
            Some(Err(problem)) => {
                self.end_prediction(question.client);
                self.send(question.client, &ServerMessage::Problem { problem });
            }
            None => {}
        }
    }

    /// The client has drawn ghosts up to this one.
    pub(super) fn received_ghost(&mut self, client: ClientId, sequence: u32) {
        let Some(connected) = self.connected_mut(client) else { return };
        connected.prediction_view.in_flight =
            connected.prediction_view.in_flight.filter(|&ghost| ghost > sequence);
        self.send_ghost(client);
    }

    fn send_ghost(&mut self, client: ClientId) {
        let Some(connected) = self.connected_mut(client) else { return };
        if connected.prediction_view.in_flight.is_some() {
            return;
        }
        let Some(ghost) = connected.prediction_view.ready.take() else { return };
        connected.prediction_view.in_flight = Some(connected.prediction_view.number);
        connected.prediction_view.is_shown = true;
        self.outputs.push_back(Output::Frame(client, ghost));
    }
}
