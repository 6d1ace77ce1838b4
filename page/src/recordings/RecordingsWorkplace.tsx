// The workplace "Recordings": events of recordings, their moduli, and the model beside each image.
export function RecordingsWorkplace() {
  return (
    <section class="recordings" aria-label="Recordings">
      <p>No recordings yet.</p>
    </section>
  );
}
